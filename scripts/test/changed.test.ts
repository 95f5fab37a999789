import { describe, expect, it } from 'vitest';
import { type Layer, msTaken, selectChanged, type TestFile, testFiles, type Workspace } from './changed.ts';

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

function read(
  changes: Record<string, string> = {},
  tools = '',
  known: ReadonlySet<string> | null = null,
): TestFile[] {
  const all = { ...FILES, ...changes };
  const packages = ['packages/a', 'packages/c', 'apps/webxr'].map((folder) => ({
    ...{ folder, name: `@farpoint/${folder.split('/')[1]}`, exports: { '.': './src/index.ts' } },
  }));
  const workspace: Workspace = {
    ...{ files: Object.keys(all), packages },
    read: (file) => new TextEncoder().encode(all[file as keyof typeof all] ?? ''),
  };
  return testFiles(workspace, tools, { hasInput: (hash) => known?.has(hash) ?? false });
}

function hashes(changes?: Record<string, string>, tools?: string): Map<string, string | null> {
  return new Map(read(changes, tools).map(({ step, file, hash }) => [`${step} ${file}`, hash]));
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

describe('distance', () => {
  const known = new Set(read().flatMap(({ inputs }) => inputs));
  const distancesAfter = (changes: Record<string, string>) =>
    Object.fromEntries(
      read(changes, '', known).map(({ file, distance }) => [file.replace(/.*\//, ''), distance]),
    );
  const none = Number.POSITIVE_INFINITY;

  it('counts the imports to what has changed', () => {
    expect(distancesAfter({ 'packages/a/src/a.ts': 'new' })).toEqual({
      ...{ 'a.test.ts': 1, 'c.test.ts': 2, 'stop.page.ts': 3 },
      ...{ 'b.test.ts': none, 'far.scenario.test.ts': none, 'rules.test.ts': none },
    });
  });

  it('a test that may read data that has changed is as near as its package', () => {
    expect(distancesAfter({ 'packages/c/vectors/one.json': '2' })).toMatchObject({
      ...{ 'c.test.ts': 0, 'far.scenario.test.ts': 0, 'a.test.ts': none },
    });
  });
});

describe('selection', () => {
  const LAYERS: Layer[] = [
    { step: 'pure', tests: /pure/, startMs: 1000, fileMs: 500 },
    { step: 'page', tests: /page/, startMs: 2000, fileMs: 5000, after: ['build'] },
  ];
  const STEPS = ['lint', 'types', 'pure', 'build', 'page', 'stack'];
  const test = (step: string, name: string, distance = 1): TestFile => ({
    ...{ step, file: `${name}.${step}.ts`, hash: name, inputs: [], distance },
  });
  const tests = [test('pure', 'a'), test('pure', 'b'), test('page', 'c')];

  interface Choice {
    tests?: readonly TestFile[];
    /** Names of tests. */
    passed?: readonly string[];
    ms?: Readonly<Record<string, number>>;
    steps?: readonly string[];
    limitMs?: number;
  }

  function select({ passed = [], ms = {}, steps = STEPS, limitMs = 60_000, ...choice }: Choice) {
    const before = {
      has: (hash: string) => passed.includes(hash),
      hasInput: () => false,
      msOf: (name: string) => ms[name],
    };
    return selectChanged(choice.tests ?? tests, before, steps, limitMs, LAYERS);
  }

  it('runs lint, types and what has not passed, and says what it leaves out', () => {
    const { steps, files, leftOut } = select({ passed: ['a', 'c'] });
    expect(steps).toEqual(['lint', 'types', 'pure']);
    expect([...files]).toEqual([['pure', ['b.pure.ts']]]);
    expect(leftOut).toBe(
      'left out: 2 of 3 files of tests, which have passed here with what they depend on; build, stack',
    );
  });

  it('builds the page before its tests', () => {
    expect(select({ passed: ['a', 'b'] }).steps).toEqual(['lint', 'types', 'build', 'page']);
  });

  it('a step that does not exist is no fault', () => {
    expect(select({ steps: ['lint', 'pure'] }).steps).toEqual(['lint', 'pure']);
  });

  const many = [
    ...[test('pure', 'far', 3), test('pure', 'near', 1), test('pure', 'slow', 2), test('pure', 'quick', 2)],
    ...[test('page', 'page', 0), { ...test('pure', 'whole', 9), hash: null }],
  ];
  const ms = { lint: 1000, types: 2000, build: 4000, 'slow.pure.ts': 900, 'quick.pure.ts': 100 };
  const chosen = (limitMs: number) => [...select({ tests: many, ms, limitMs }).files.values()].flat();
  const inOrder = ['whole.pure.ts', 'near.pure.ts', 'quick.pure.ts', 'slow.pure.ts', 'far.pure.ts'];

  it('takes what looks at everything, then the nearest, of equally near ones the quickest, as long as there is time', () => {
    const ends = [0, 4500, 5000, 5100, 6000, 6500].map((limitMs) => chosen(limitMs).length);
    expect(ends).toEqual([1, 1, 2, 3, 4, 5]);
    expect(chosen(6500)).toEqual(inOrder);
  });

  it('counts what has to run before a layer', () => {
    expect(chosen(17_499)).toEqual(inOrder);
    expect(chosen(17_500)).toEqual([...inOrder, 'page.page.ts']);
  });

  it('says what is left for another run', () => {
    expect(select({ tests: many, ms, limitMs: 6100 }).leftOut).toMatch(
      /left for later: 1 pure, 1 page .*again goes on/,
    );
    expect(select({ tests: many, ms, limitMs: Number.POSITIVE_INFINITY }).leftOut).not.toContain('later');
  });
});

it('what a step took is shared among its files, and what failed took nothing', () => {
  const passed = (file: string, ms: number) => ({
    ...{ file, title: '', status: 'passed' as const, ms, reason: '', line: null, attachments: [] },
    ...{ verdict: 'passed' as const, alone: [] },
  });
  const layers: Layer[] = [{ step: 'pure', tests: /./, startMs: 1000, fileMs: 0 }];
  const steps = [
    { name: 'lint', ms: 700, ok: true, judged: [] },
    { name: 'types', ms: 900, ok: false, judged: [] },
    { name: 'pure', ms: 1550, ok: true, judged: [passed('a', 10), passed('a', 30), passed('b', 970)] },
  ];
  expect(msTaken(steps, layers)).toEqual({
    lint: 700,
    a: expect.closeTo(550 * (70 / 1070)),
    b: expect.closeTo(550 * (1000 / 1070)),
  });
});
