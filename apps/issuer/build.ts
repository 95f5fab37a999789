/**
 * `pnpm --filter @farpoint/issuer build`: bundles the program into one file, dist/issuer.mjs, that runs with
 * plain Node ≥ 22 and nothing else. `node build.ts FILE` writes it elsewhere.
 */
import { join } from 'node:path';
import { build } from 'esbuild';

const outfile = process.argv[2] ?? join(import.meta.dirname, 'dist/issuer.mjs');

await build({
  absWorkingDir: import.meta.dirname,
  entryPoints: ['src/main.ts'],
  outfile,
  bundle: true,
  platform: 'node',
  target: 'node22',
  format: 'esm',
  // Keeps names readable in stack traces.
  minifySyntax: true,
  legalComments: 'inline',
  // CommonJS packages inside an ES module load Node's own modules with `require`.
  banner: {
    js: "import { createRequire as __createRequire } from 'node:module'; const require = __createRequire(import.meta.url);",
  },
});
console.log(outfile);
