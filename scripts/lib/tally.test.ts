import { describe, expect, it } from 'vitest';
import { addTallies, tallyCargo } from './tally.ts';

describe('tally', () => {
  it('sums the results of every cargo test binary', () => {
    const output = [
      'test result: ok. 12 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out',
      'test result: FAILED. 3 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out',
    ].join('\n');
    expect(tallyCargo(output)).toEqual({ passed: 15, failed: 2, skipped: 1 });
  });

  it('gives zeros for output without a summary', () => {
    expect(addTallies(tallyCargo('boom'), tallyCargo(''))).toEqual({ passed: 0, failed: 0, skipped: 0 });
  });
});
