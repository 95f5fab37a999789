/** Counts tests from the summaries that cargo prints. */
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
