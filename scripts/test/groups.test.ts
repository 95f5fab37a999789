import { describe, expect, it } from 'vitest';
import { workspaceFiles } from '../lib/workspace-files.ts';
import { groupsOfWorkspace, workspacePackages } from './group-states.ts';
import { type Group, hashOf, inputsOf, readGroups, type WorkspacePackage } from './groups.ts';
import { NEEDS } from './needs.ts';

const group: Group = {
  ...{ name: 'video', what: 'video', needs: [] },
  tests: ['apps/robot/src/video.stack.test.ts'],
  inputs: ['apps/robot', 'scripts/tool.ts'],
};
const package_ = (folder: string, uses: string[] = [], testsUse: string[] = []): WorkspacePackage => ({
  ...{ folder, name: `@x/${folder.split('/').at(-1)}` },
  ...{ uses: uses.map((name) => `@x/${name}`), testsUse: testsUse.map((name) => `@x/${name}`) },
});
const packages = [
  package_('apps/robot', ['codec'], ['stack']),
  package_('packages/codec', ['bits']),
  // Two that use each other, and whose tests use a third.
  package_('packages/bits', ['codec'], ['page']),
  package_('packages/stack'),
  package_('packages/page'),
];
const files = [
  'apps/robot/src/video.ts',
  'apps/robot/src/video.test.ts',
  'apps/robot/src/video.stack.test.ts',
  'apps/robot/native/video.c',
  'apps/robots/src/other.ts',
  'packages/codec/src/codec.ts',
  'packages/bits/src/bits.ts',
  'packages/stack/src/stack.ts',
  'packages/page/src/page.ts',
  'scripts/tool.ts',
  'scripts/tools.ts',
  'pnpm-lock.yaml',
];

describe('a group’s inputs', () => {
  it('are its tests, its folders, and those of all packages that they use, without other tests', () => {
    expect(inputsOf(group, files, packages)).toEqual([
      'apps/robot/native/video.c',
      'apps/robot/src/video.stack.test.ts',
      'apps/robot/src/video.ts',
      'packages/bits/src/bits.ts',
      'packages/codec/src/codec.ts',
      'packages/stack/src/stack.ts',
      'pnpm-lock.yaml',
      'scripts/tool.ts',
    ]);
  });

  it('have another hash when one of them changes, comes, goes or has another name', () => {
    const read = (changed?: string) => (file: string) => Buffer.from(file === changed ? 'changed' : 'same');
    const inputs = inputsOf(group, files, packages);
    const hashes = [
      hashOf(inputs, read()),
      ...inputs.map((file) => hashOf(inputs, read(file))),
      ...inputs.map((file) =>
        hashOf(
          inputs.filter((each) => each !== file),
          read(),
        ),
      ),
      hashOf([...inputs.slice(0, -1), 'scripts/renamed.ts'], read()),
    ];
    expect(new Set(hashes).size).toBe(hashes.length);
    expect(hashOf(inputs, read())).toBe(hashes[0]);
  });
});

it('refuses a group with a field that nobody reads', () => {
  expect(() => readGroups('a: { what: x, inputs: [], input: [] }')).toThrow(/input/);
  expect(() => readGroups('a: { what: x }')).toThrow(/inputs/);
});

describe('tests/groups.yaml', () => {
  const groups = groupsOfWorkspace();

  it('names files that exist, each in one group', () => {
    const tests = groups.flatMap((each) => each.tests);
    expect(tests.filter((file) => !workspaceFiles.includes(file))).toEqual([]);
    expect(tests.filter((file) => !file.endsWith('.stack.test.ts'))).toEqual([]);
    expect(new Set(tests).size).toBe(tests.length);
  });

  it.each(groups)('$name: what it depends on exists, its own sources among it', (each) => {
    const missing = each.inputs.filter(
      (input) => !workspaceFiles.some((file) => file === input || file.startsWith(`${input}/`)),
    );
    expect(missing).toEqual([]);
    const inputs = inputsOf(each, workspaceFiles, workspacePackages());
    for (const test of each.tests) expect(inputs).toContain(test);
    // The package of each test, which the test may start as a program.
    for (const test of each.tests) {
      const folder = /^(?:(?:packages|apps|tools)\/[^/]+|wasm-codec|scripts)/.exec(test)?.[0] ?? '';
      expect(inputs.some((file) => file.startsWith(`${folder}/`) && !file.endsWith('.test.ts'))).toBe(true);
    }
    for (const need of each.needs) expect(NEEDS.map(({ name }) => name)).toContain(need);
  });
});
