/**
 * Makes one file of each program's thousand modules, beside the sources that it is made of: for the tests, which start
 * programs hundreds of times. Addons, WASM and Python stay where they are; worker threads get files of their own.
 */
import { globSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, dirname, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { build, type Plugin } from 'esbuild';
import { root } from './run.ts';

const PROGRAMS = ['bridge', 'issuer', 'link-emulator', 'robot-node', 'signaling'] as const;
/** Threads of these programs. */
const WORKERS = '{apps/robot-node,packages/recording}/src/**/*-worker.ts';

/** They look for files beside themselves. */
const UNBUNDLED = /^(pino|@foxglove\/wasm-bz2)$/;

/** @param folder where the programs go; what it had is removed @throws {Error} with the compiler's message */
export async function bundlePrograms(folder: string): Promise<void> {
  const workers = globSync(WORKERS, { cwd: root });
  const entries = [
    ...PROGRAMS.map((name) => [name, `apps/${name}/src/main.ts`] as const),
    ...workers.map((file) => [basename(file, '.ts'), file] as const),
  ];
  rmSync(folder, { recursive: true, force: true });
  await build({
    absWorkingDir: root,
    entryPoints: Object.fromEntries(entries),
    outdir: folder,
    outExtension: { '.js': '.mjs' },
    bundle: true,
    splitting: true,
    format: 'esm',
    platform: 'node',
    target: 'node24',
    logLevel: 'warning',
    // Optional parts of ws.
    external: ['bufferutil', 'utf-8-validate'],
    banner: {
      js: "import { createRequire as requireOf } from 'node:module'; const require = requireOf(import.meta.url);",
    },
    plugins: [unbundled(), besideSources(new Set(workers.map((file) => basename(file, '.ts'))))],
  });
}

function unbundled(): Plugin {
  return {
    name: 'unbundled',
    setup: ({ onResolve }) =>
      onResolve({ filter: UNBUNDLED }, ({ path, importer }) => ({
        path: createRequire(importer).resolve(path),
        external: true,
      })),
  };
}

/** To each module its own place; to those that start worker threads, the threads' bundles. */
function besideSources(workers: ReadonlySet<string>): Plugin {
  return {
    name: 'beside-sources',
    setup: ({ onLoad }) =>
      onLoad({ filter: /\.ts$/ }, ({ path }) => {
        const text = readFileSync(path, 'utf8');
        if (path.includes('node_modules') || !text.includes('import.meta')) return null;
        const place = { url: pathToFileURL(path).href, dirname: dirname(path), filename: path };
        const contents = text
          .replace(/new URL\('\.\/([\w-]+)\.ts', import\.meta\.url\)/g, (all, name: string) =>
            workers.has(name) ? `new URL('./${name}.mjs', import.meta.bundle)` : all,
          )
          .replace(/import\.meta\.(url|dirname|filename)\b/g, (_, key: keyof typeof place) =>
            JSON.stringify(place[key]),
          )
          .replaceAll('import.meta.bundle', 'import.meta.url');
        return { contents, loader: 'ts' };
      }),
  };
}

/** Where the tests' programs are. */
export const bundledPrograms = join(root, '.farpoint', 'programs');
