import { describe, expect, it } from 'vitest';
import { selectChanged, testFiles, type Workspace } from './changed.ts';

const FILES: Record<string, string> = {
  'packages/a/package.json': '{}',
  'packages/a/src/index.ts': "export * from './a.ts';",
  'packages/a/src/a.ts': 'export const a = 1;',
  'packages/a/src/a.test.ts': "import { a } from './a.ts';",
  'packages/a/src/b.ts': 'export const b = 1;',
  'packages/a/src/b.test.ts': "import { b } from './b.ts';",
  'packages/c/package.json': '{}',
  'packages/c/src/c.test.ts': "import { a } from '@farpoint/a';",
  'packages/c/src/c.stack.test.ts': '',
  'packages/c/src/far.scenario.test.ts': '',
  'packages/c/vectors/one.json': '1',
  'scripts/lib/workspace-files.ts': '',
  'scripts/rules.test.ts': "import './lib/workspace-files.ts';",
  'apps/webxr/package.json': '{}',
  'apps/webxr/src/main.ts': "import '@farpoint/a';",
  'e2e/pages/stop.page.ts': '',
  'pnpm-lock.yaml': '',
};

function hashes(changes: Record<string, string> = {}, tools = ''): Map<string, string | null> {
  const all = { ...FILES, ...changes };
  const packages = ['packages/a', 'packages/c', 'apps/webxr'].map((folder) => ({
    ...{ folder, name: `@farpoint/${folder.split('/')[1]}`, exports: { '.': './src/index.ts' } },
  }));
  const workspace: Workspace = {
    ...{ files: Object.keys(all), packages },
    read: (file) => new TextEncoder().encode(all[file as keyof typeof all] ?? ''),
  };
  return new Map(testFiles(workspace, tools).map(({ step, file, hash }) => [`${step} ${file}`, hash]));
}

/** The tests that have to run after these changes, if all had passed before. */
function changedBy(changes: Record<string, string>, tools?: string): string[] {
  const before = hashes();
  return [...hashes(changes, tools)]
    .filter(([test, hash]) => hash !== null && hash !== before.get(test))
    .map(([test]) => test.replace(/\S+\//, ''));
}

describe('a test has to run', () => {
  it.each<[string, Record<string, string>, string[]]>([
    ['nothing has changed', {}, []],
    ['its own file has', { 'packages/a/src/b.test.ts': 'new' }, ['pure b.test.ts']],
    ['what it imports has', { 'packages/a/src/b.ts': 'new' }, ['pure b.test.ts']],
    [
      'what a package that it uses imports has',
      { 'packages/a/src/a.ts': 'new' },
      ['pure a.test.ts', 'pure c.test.ts', 'page stop.page.ts'],
    ],
    [
      'what it may read has',
      { 'packages/c/vectors/one.json': '2' },
      ['pure c.test.ts', 'scenario far.scenario.test.ts'],
    ],
    ['the page has', { 'apps/webxr/src/main.ts': 'new' }, ['page stop.page.ts']],
  ])('if %s', (_, changes, tests) => {
    expect(changedBy(changes)).toEqual(tests);
  });

  it('if what runs it, or the versions of libraries have', () => {
    expect(changedBy({}, 'v24')).toHaveLength(5);
    expect(changedBy({ 'pnpm-lock.yaml': 'new' })).toHaveLength(5);
  });

  it('always, if it looks at all files', () => {
    expect(hashes().get('pure scripts/rules.test.ts')).toBeNull();
  });
});

describe('selection', () => {
  const tests = [
    { step: 'pure', file: 'a.test.ts', hash: 'a' },
    { step: 'pure', file: 'b.test.ts', hash: 'b' },
    { step: 'page', file: 'c.page.ts', hash: 'c' },
  ];
  const select = (proven: string[], steps: string[]) =>
    selectChanged(tests, (hash) => proven.includes(hash), steps);

  it('runs lint, types and what has not passed, and says what it leaves out', () => {
    const { steps, files, leftOut } = select(['a', 'c'], ['lint', 'types', 'pure', 'build', 'page', 'stack']);
    expect(steps).toEqual(['lint', 'types', 'pure']);
    expect([...files]).toEqual([['pure', ['b.test.ts']]]);
    expect(leftOut).toBe(
      'left out: 2 of 3 files of tests, which have passed here with what they depend on; build, stack',
    );
  });

  it('builds the page before its tests', () => {
    expect(select(['a', 'b'], ['lint', 'pure', 'build', 'page']).steps).toEqual(['lint', 'build', 'page']);
  });

  it('a step that does not exist is no fault', () => {
    expect(select([], ['lint', 'pure']).steps).toEqual(['lint', 'pure']);
  });
});
