import { globSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { brotliCompressSync, constants, gzipSync } from 'node:zlib';
import { defineConfig, type Plugin } from 'vite';

// A headset on the LAN needs https for WebXR, with a certificate that it trusts.
const { FARPOINT_HTTPS_CERT: cert, FARPOINT_HTTPS_KEY: key, FARPOINT_WEB_PORT: port } = process.env;

/**
 * Writes each file that shrinks beside itself, compressed, for servers that send such files (sirv, Caddy, nginx): a page that
 * is not compressed takes 1.2 s at 10 Mbit/s.
 */
function compressed(): Plugin {
  let folder = '';
  return {
    name: 'farpoint-compressed',
    apply: 'build',
    configResolved: ({ build }) => {
      folder = build.outDir;
    },
    closeBundle: () => {
      for (const name of globSync('**/*.{html,js,css,wasm}', { cwd: join(import.meta.dirname, folder) })) {
        const path = join(import.meta.dirname, folder, name);
        const bytes = readFileSync(path);
        const params = { [constants.BROTLI_PARAM_SIZE_HINT]: bytes.length };
        writeFileSync(`${path}.br`, brotliCompressSync(bytes, { params }));
        writeFileSync(`${path}.gz`, gzipSync(bytes, { level: 9 }));
      }
    },
  };
}

export default defineConfig(({ mode }) => ({
  // Tests need no compressed files, and brotli takes its time.
  plugins: mode === 'testing' ? [] : [compressed()],
  // Works under any path.
  base: './',
  server: {
    port: port === undefined ? 5173 : Number(port),
    ...(cert === undefined || key === undefined
      ? {}
      : { host: true, https: { cert: readFileSync(cert), key: readFileSync(key) } }),
    headers: { 'Permissions-Policy': 'xr-spatial-tracking=(self), gamepad=(self)' },
  },
  worker: { format: 'es' },
  build: {
    target: 'es2022',
    // The operator's page, several of it side by side, and the page for those who only watch.
    rolldownOptions: { input: ['index.html', 'wall.html', 'watch.html'] },
    // The WASM module stays a file, so that it compiles while it streams in.
    assetsInlineLimit: 0,
    // The testing build includes `window.farpoint`, for tests and benchmarks.
    outDir: mode === 'testing' ? 'dist-testing' : 'dist',
    sourcemap: true,
    chunkSizeWarningLimit: 900,
  },
}));
