import { describe, expect, it } from 'vitest';
import { tieDashValues } from './dash-values.ts';

const OPTIONS = {
  for: { type: 'string' },
  key: { type: 'string' },
  'with-key': { type: 'boolean' },
} as const;

describe('a value that begins with a dash', () => {
  it.each([
    [
      ['--for', '-30RDHZv', '--key', 'k'],
      ['--for=-30RDHZv', '--key', 'k'],
    ],
    [['--for', '--AbCd'], ['--for=--AbCd']],
    [
      ['--key', 'k', '--for', '-x'],
      ['--key', 'k', '--for=-x'],
    ],
  ])('%j is tied to its option', (argv, tied) => {
    expect(tieDashValues(argv, OPTIONS)).toEqual(tied);
  });

  it.each([
    // The value was forgotten.
    [['--for', '--with-key']],
    [['--for', '--key=k']],
    [['--for', '--', 'x']],
    [['--for']],
    // Standard input; no option; no value.
    [['--key', '-']],
    [['-30RDHZv']],
    [['--with-key', '-x']],
    [['--toString', '-x']],
    [['--for=-x', '-y']],
  ])('%j stays as it is', (argv) => {
    expect(tieDashValues(argv, OPTIONS)).toEqual(argv);
  });
});
