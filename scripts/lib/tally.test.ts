import { describe, expect, it } from 'vitest';
import { addTallies, tallyCargo, tallyPlaywright, tallyVitest } from './tally.ts';

describe('tally', () => {
  it('sums the results of every cargo test binary', () => {
    const output = [
      'test result: ok. 12 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out',
      'test result: FAILED. 3 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out',
    ].join('\n');
    expect(tallyCargo(output)).toEqual({ passed: 15, failed: 2, skipped: 1 });
  });

  it('reads the coloured summary of vitest', () => {
    const output =
      ' Test Files  1 failed | 9 passed (10)\n\u001b[2m      Tests \u001b[22m 1 failed | 20 passed | 3 skipped (24)\n';
    expect(tallyVitest(output)).toEqual({ passed: 20, failed: 1, skipped: 3 });
  });

  it('counts a flaky end-to-end test as failed', () => {
    expect(tallyPlaywright('  1 flaky\n    a › b\n  2 skipped\n  7 passed (1.2m)\n')).toEqual({
      passed: 7,
      failed: 1,
      skipped: 2,
    });
  });

  it('gives zeros for output without a summary', () => {
    expect(addTallies(tallyVitest('boom'), tallyPlaywright('boom'))).toEqual({
      passed: 0,
      failed: 0,
      skipped: 0,
    });
  });
});
