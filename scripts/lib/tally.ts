import { stripVTControlCharacters } from 'node:util';

/** Counts tests from the summaries that the test runners print. */
export interface Tally {
  passed: number;
  failed: number;
  skipped: number;
}

export function addTallies(a: Tally, b: Tally): Tally {
  return { passed: a.passed + b.passed, failed: a.failed + b.failed, skipped: a.skipped + b.skipped };
}

export const emptyTally: Tally = { passed: 0, failed: 0, skipped: 0 };

/** Sums every `test result:` line of `cargo test`. */
export function tallyCargo(output: string): Tally {
  let tally = emptyTally;
  for (const match of output.matchAll(/^test result: \S+ (\d+) passed; (\d+) failed; (\d+) ignored/gm)) {
    tally = addTallies(tally, {
      passed: Number(match[1]),
      failed: Number(match[2]),
      skipped: Number(match[3]),
    });
  }
  return tally;
}

/** Reads vitest's `Tests  1 failed | 2 passed | 3 skipped (6)` line. */
export function tallyVitest(output: string): Tally {
  return readCounts(/^\s*Tests\s+(.*)$/m.exec(stripVTControlCharacters(output))?.[1] ?? '');
}

/** Reads Playwright's last lines, `3 passed (12.0s)`, `1 failed`, `2 skipped`; a flaky test counts as failed. */
export function tallyPlaywright(output: string): Tally {
  const lines = stripVTControlCharacters(output)
    .split('\n')
    .filter((line) => /^\s*\d+ (passed|failed|skipped|flaky|did not run)\b/.test(line))
    .join(' | ');
  return readCounts(lines);
}

function readCounts(text: string): Tally {
  const count = (word: string): number => Number(new RegExp(`(\\d+) ${word}`).exec(text)?.[1] ?? 0);
  return {
    passed: count('passed'),
    failed: count('failed') + count('flaky'),
    skipped: count('skipped') + count('did not run'),
  };
}
