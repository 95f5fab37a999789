import { expect, it } from 'vitest';
import { ImportGraph } from './import-graph.ts';

const files: Record<string, string> = {
  'packages/a/src/index.ts': "export * from './one.ts';\nexport type { Two } from './two.ts';",
  'packages/a/src/one.ts': "// import './comment.ts';\nexport const one = 1;",
  'packages/a/src/two.ts': "const worker = new URL('./worker.ts', import.meta.url);",
  'packages/a/src/worker.ts': "import './one.ts';",
  'packages/a/src/comment.ts': '',
  'packages/a/src/parts/index.ts': '',
  'packages/b/src/b.ts': "import { one } from '@farpoint/a';\nimport { b } from './b.ts';",
  'packages/b/src/part.ts': "const lazy = await import('@farpoint/a/parts');",
  'packages/b/src/own.ts': "import '@farpoint/a/absent';\nimport fc from 'fast-check';",
};
const graph = new ImportGraph(
  Object.keys(files),
  [
    {
      ...{ folder: 'packages/a', name: '@farpoint/a' },
      exports: {
        '.': './src/index.ts',
        './parts': { types: './dist/x.d.ts', default: './src/parts/index.ts' },
      },
    },
  ],
  (file) => files[file] ?? '',
);
const names = (file: string) =>
  graph.closureOf(file).map((each) => each.replace('packages/', '').replace('src/', ''));

it('follows files and packages, threads as well, and no comments', () => {
  expect(names('packages/b/src/b.ts')).toEqual([
    'a/index.ts',
    'a/one.ts',
    'a/two.ts',
    'a/worker.ts',
    'b/b.ts',
  ]);
});

it('follows the entry that is meant', () => {
  expect(names('packages/b/src/part.ts')).toEqual(['a/parts/index.ts', 'b/part.ts']);
});

it('where the entry is not known, all of the package counts', () => {
  expect(names('packages/b/src/own.ts')).toHaveLength(7);
});

it('says how far a file is from those that have changed', () => {
  const distances = graph.distancesTo(['packages/a/src/one.ts']);
  const of = (...names: string[]) => names.map((name) => distances.get(`packages/${name}`));
  expect(of('a/src/one.ts', 'a/src/index.ts', 'b/src/b.ts', 'a/src/two.ts')).toEqual([0, 1, 2, 2]);
  expect(of('a/src/comment.ts', 'a/src/parts/index.ts', 'b/src/part.ts')).toEqual(
    [1, 1, 1].map(() => undefined),
  );
});
