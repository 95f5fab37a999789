import { describe, expect, it } from 'vitest';
import { readWorkspaceFile, workspaceFiles } from '../lib/workspace-files.ts';
import { mutate, readMutants } from './mutant.ts';

const [mutant] = readMutants("a: { what: x, file: f.ts, from: 'return 1;', to: '', found-by: [pure] }");

describe('a mutant', () => {
  it('replaces the one place that it names', () => {
    expect(mutate(mutant!, 'before return 1; after')).toBe('before  after');
  });

  it.each(['return 2;', 'return 1; return 1;'])('does not go into a file with %j', (text) => {
    expect(() => mutate(mutant!, text)).toThrow(/a: .*found.* in f\.ts/);
  });

  it('has tests that are to find it', () => {
    expect(() => readMutants('a: { what: x, file: f, from: y, to: z, found-by: [] }')).toThrow(/found-by/);
  });
});

describe('tests/mutants.yaml', () => {
  it.each(readMutants(readWorkspaceFile('tests/mutants.yaml')))('$name fits its file', (each) => {
    expect(mutate(each, readWorkspaceFile(each.file))).not.toBe(readWorkspaceFile(each.file));
    for (const tests of each.foundBy) if (tests !== 'pure') expect(workspaceFiles).toContain(tests);
  });
});
