/**
 * `pnpm --filter @farpoint/signaling build`: the service as one file, dist/signaling.mjs, that runs with plain Node ≥ 22
 * and nothing beside it. `node build.ts FILE` writes it elsewhere.
 */
import { join } from 'node:path';
import { build } from 'esbuild';

const outfile = process.argv[2] ?? join(import.meta.dirname, 'dist/signaling.mjs');

await build({
  absWorkingDir: import.meta.dirname,
  entryPoints: ['src/main.ts'],
  outfile,
  bundle: true,
  platform: 'node',
  target: 'node22',
  format: 'esm',
  // Names stay readable in stack traces.
  minifySyntax: true,
  legalComments: 'inline',
  // CommonJS packages inside an ES module ask for Node's own modules with `require`.
  banner: {
    js: "import { createRequire as __createRequire } from 'node:module'; const require = __createRequire(import.meta.url);",
  },
  // ws uses them where they are installed.
  external: ['bufferutil', 'utf-8-validate'],
});
console.log(outfile);
