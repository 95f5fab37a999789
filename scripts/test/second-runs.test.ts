import { describe, expect, it } from 'vitest';
import type { Outcome } from './outcome.ts';
import { MOST_AGAIN, type RunFile, runFilesAgain } from './second-runs.ts';

const outcome = (file: string, title: string, status: Outcome['status'] = 'failed'): Outcome => ({
  ...{ file, title, status, ms: 1, reason: '', line: null, attachments: [] },
});

/** Gives these outcomes, one list for each run, and notes what it was asked for. */
function runner(...runs: Outcome[][]): { run: RunFile; asked: [string, readonly string[] | null][] } {
  const asked: [string, readonly string[] | null][] = [];
  return {
    asked,
    run: (file, titles) => {
      asked.push([file, titles]);
      return Promise.resolve(runs[(asked.length - 1) % runs.length] ?? []);
    },
  };
}
const short = new Map([['a.ts', 1000]]);
const statuses = (outcomes: readonly Outcome[]) => outcomes.map(({ title, status }) => [title, status]);

describe('what failed is run again alone', () => {
  it('twice, the whole file, and only the tests that failed are reported', async () => {
    const { run, asked } = runner(
      [outcome('a.ts', 'one', 'passed'), outcome('a.ts', 'two', 'failed')],
      [outcome('a.ts', 'one', 'failed'), outcome('a.ts', 'two', 'failed')],
    );
    const alone = await runFilesAgain([outcome('a.ts', 'one')], short, run);
    expect(asked).toEqual([
      ['a.ts', null],
      ['a.ts', null],
    ]);
    expect(statuses(alone)).toEqual([
      ['one', 'passed'],
      ['one', 'failed'],
    ]);
  });

  it('of a long file, only the tests that failed', async () => {
    const { run, asked } = runner([]);
    const failed = [outcome('a.ts', 'one'), outcome('a.ts', 'two')];
    await runFilesAgain(failed, new Map([['a.ts', 160_000]]), run);
    expect(asked[0]).toEqual(['a.ts', ['one', 'two']]);
  });

  it('a file that could not be loaded has passed if a test in it passes and none fails', async () => {
    const whole = outcome('a.ts', '');
    const runs = runner(
      [outcome('a.ts', 'one', 'passed')],
      [outcome('a.ts', 'one', 'passed'), outcome('a.ts', 'two', 'failed')],
    );
    expect(statuses(await runFilesAgain([whole], short, runs.run))).toEqual([['', 'passed']]);
    const skipped = runner([outcome('a.ts', 'one', 'skipped')]);
    expect(await runFilesAgain([whole], short, skipped.run)).toEqual([]);
    const still = runner([outcome('a.ts', '')]);
    expect(statuses(await runFilesAgain([whole], short, still.run))).toEqual([
      ['', 'failed'],
      ['', 'failed'],
    ]);
  });

  it('counts nothing of another file, and nothing where no report came', async () => {
    const { run } = runner([outcome('b.ts', 'one', 'passed')], []);
    expect(await runFilesAgain([outcome('a.ts', 'one')], short, run)).toEqual([]);
  });

  it('but not a great number of tests', async () => {
    const { run, asked } = runner([]);
    const failed = Array.from({ length: 20 }, (_, n) => outcome(`${n}.ts`, 't'));
    await runFilesAgain(failed, new Map(), run);
    expect(new Set(asked.map(([file]) => file)).size).toBe(MOST_AGAIN);
  });
});
