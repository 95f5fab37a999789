import { expect, test } from 'vitest';
import { importedFiles, startedFiles } from './file-imports.ts';

test('finds the files that a file imports by path, in every form, and nothing else', () => {
  const source = `
    import { a } from './a.ts';
    import type { B } from '../b/b.ts';
    import './c.css';
    export * from "./d.ts";
    const e = await import('./e.ts');
    import { join } from 'node:path';
    import { x } from '@farpoint/x';
    /* import { f } from './f.ts'; */
    // import { g } from './g.ts';
    import {
      h,
    } from './h/h.ts';
  `;
  expect([...importedFiles('packages/p/src/main.ts', source)].sort()).toEqual([
    'packages/p/b/b.ts',
    'packages/p/src/a.ts',
    'packages/p/src/c.css',
    'packages/p/src/d.ts',
    'packages/p/src/e.ts',
    'packages/p/src/h/h.ts',
  ]);
});

test('a thread that a file starts is found', () => {
  const source =
    "new Worker(new URL('../b/worker.ts', import.meta.url));\n// new URL('./c.ts')\nnew URL('https://a.ts');";
  expect([...startedFiles('src/a/main.ts', source)]).toEqual(['src/b/worker.ts']);
});
