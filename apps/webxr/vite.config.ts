import { readFileSync } from 'node:fs';
import { defineConfig } from 'vite';

// A headset on the LAN needs https for WebXR, with a certificate that it trusts.
const { FARPOINT_HTTPS_CERT: cert, FARPOINT_HTTPS_KEY: key, FARPOINT_WEB_PORT: port } = process.env;

const OFFLINE_WORKER = 'offline-worker';

export default defineConfig(({ mode }) => ({
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
    // The operator's page, several of it side by side, and the one for those who only watch.
    rolldownOptions: {
      input: ['index.html', 'wall.html', 'watch.html', `src/offline/${OFFLINE_WORKER}.ts`],
      output: {
        // A service worker has power over what is beside and below it, and keeps its name over versions.
        entryFileNames: ({ name }) => (name === OFFLINE_WORKER ? '[name].js' : 'assets/[name]-[hash].js'),
      },
    },
    // The WASM module stays a file, so that it compiles while it streams in.
    assetsInlineLimit: 0,
    // The testing build includes `window.farpoint`, for tests and benchmarks.
    outDir: mode === 'testing' ? 'dist-testing' : 'dist',
    sourcemap: true,
    chunkSizeWarningLimit: 900,
  },
}));
