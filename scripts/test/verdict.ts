/**
 * Decides what a run of tests on real clocks, processes and browsers says about the product. Pure.
 *
 * A test that fails is run again alone, twice. If it fails again, it has failed. If it passes both times, it is flaky:
 * it is listed and counted, and the run stays green, unless there are too many of them.
 */
import { nameOf, type Outcome } from './outcome.ts';
import { type Quarantined, quarantineOf } from './quarantine.ts';

/** How often a failed test is run again, alone. */
export const SECOND_RUNS = 2;
/** More flaky tests than this in a whole run: something is wrong with the product or the machine. */
export const MOST_FLAKY = 3;

export interface Judged extends Outcome {
  verdict: 'passed' | 'failed' | 'flaky' | 'quarantined' | 'skipped';
  /** How it ended alone. */
  alone: readonly Outcome[];
}

/** The tests that have to be run again before anything is decided. */
export function toRunAgain(
  outcomes: readonly Outcome[],
  quarantine: readonly Quarantined[],
): readonly Outcome[] {
  return outcomes.filter(
    (outcome) => outcome.status === 'failed' && quarantineOf(outcome, quarantine) === undefined,
  );
}

/**
 * @param outcomes of the run @param again of the runs alone, of any tests; a test that is not among them was not run
 * again
 */
export function judge(
  outcomes: readonly Outcome[],
  again: readonly Outcome[],
  quarantine: readonly Quarantined[],
): Judged[] {
  const aloneOf = Map.groupBy(again, nameOf);
  return outcomes.map((outcome): Judged => {
    const alone = aloneOf.get(nameOf(outcome)) ?? [];
    if (quarantineOf(outcome, quarantine) !== undefined && outcome.status !== 'skipped')
      return { ...outcome, verdict: 'quarantined', alone };
    if (outcome.status !== 'failed') return { ...outcome, verdict: outcome.status, alone };
    const passed = alone.filter(({ status }) => status === 'passed').length;
    const isFlaky = passed === alone.length && passed >= SECOND_RUNS;
    return { ...outcome, verdict: isFlaky ? 'flaky' : 'failed', alone };
  });
}
