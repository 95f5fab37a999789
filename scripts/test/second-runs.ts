/** Runs again, alone, what has failed. Pure but for the runner that it is given. */
import type { Outcome } from './outcome.ts';
import { SECOND_RUNS } from './verdict.ts';

/** More failures than this are not run again: the run has failed, and these are enough to find out why. */
export const MOST_AGAIN = 6;
/** A file that takes longer is run again for its failed tests only, which then must not depend on the others. */
const LONG_FILE_MS = 100_000;

/** Of vitest's option `-t`: these tests and no others. @param titles with ` > ` between a test and what it is in */
export function namePattern(titles: readonly string[]): string {
  const names = titles.map((title) => title.replace(/[.*+?^${}()|[\]\\]/g, '\\$&'));
  return `^(?:${names.join('|')})$`;
}

/** Runs one file alone. @param titles the tests of it that are to run; `null`: all */
export type RunFile = (file: string, titles: readonly string[] | null) => Promise<readonly Outcome[]>;

/**
 * Files are the unit, because tests of a file may depend on each other.
 *
 * @param failed what has failed, of any files @param fileMs how long each file took
 * @returns how these tests ended, once for each run; a test that did not run is not among them
 */
export async function runFilesAgain(
  failed: readonly Outcome[],
  fileMs: ReadonlyMap<string, number>,
  run: RunFile,
): Promise<Outcome[]> {
  const alone: Outcome[] = [];
  const files = Map.groupBy(failed.slice(0, MOST_AGAIN), ({ file }) => file);
  for (const [file, tests] of files) {
    const titles = tests.map(({ title }) => title);
    const failedAsWhole = titles.includes('');
    const isLong = (fileMs.get(file) ?? 0) > LONG_FILE_MS && !failedAsWhole;
    for (let time = 0; time < SECOND_RUNS; time++) {
      const outcomes = (await run(file, isLong ? titles : null)).filter((outcome) => outcome.file === file);
      alone.push(...outcomes.filter(({ title }) => titles.includes(title)));
      // A file that could not be loaded or set up now can be: it has passed if something in it has, and nothing failed.
      const whole = tests.find(({ title }) => title === '');
      const passes =
        outcomes.some(({ status }) => status === 'passed') &&
        outcomes.every(({ status }) => status !== 'failed');
      if (whole !== undefined && passes) alone.push({ ...whole, status: 'passed' });
    }
  }
  return alone;
}
