/** Counts how often tests failed in repeated runs, and judges that by the budget of their layer. Pure. */
import { nameOf } from './outcome.ts';
import type { StepSummary } from './summary.ts';

/** What may fail without a fault: shares of tests that ran. */
interface Budget {
  firstTries: number;
  afterRerun: number;
}

const NOTHING: Budget = { firstTries: 0, afterRerun: 0 };
/** Real time and real processes. All other steps are deterministic, and may fail never. */
const BUDGETS: Readonly<Record<string, Budget>> = {
  stack: { firstTries: 0.0005, afterRerun: 0 },
  smoke: { firstTries: 0.01, afterRerun: 0 },
  firefox: { firstTries: 0.01, afterRerun: 0 },
};

export interface LayerFlakes {
  step: string;
  /** Tests that ran, all repetitions together. */
  tries: number;
  /** How many failed at the first try, and how many of these have failed, whatever a second run said. */
  first: number;
  afterRerun: number;
  /** Repetitions in which the step failed without a test that failed: a build, a report that is missing. */
  stepFailures: number;
  budget: Budget;
  ok: boolean;
}

export interface TestFlakes {
  step: string;
  test: string;
  tries: number;
  first: number;
  afterRerun: number;
  /** Of its last failure. */
  reason: string;
}

export interface Flakes {
  layers: LayerFlakes[];
  /** Those that have failed at least once, most often first. */
  tests: TestFlakes[];
  ok: boolean;
}

/** @param repetitions the steps of each repetition; tests in quarantine do not count */
export function countFlakes(repetitions: readonly (readonly StepSummary[])[]): Flakes {
  const layers = new Map<string, LayerFlakes>();
  const tests = new Map<string, TestFlakes>();
  for (const { name: step, ok, judged } of repetitions.flat()) {
    const budget = BUDGETS[step] ?? NOTHING;
    const none = { step, tries: 0, first: 0, afterRerun: 0, stepFailures: 0, budget, ok: true };
    const layer = layers.get(step) ?? none;
    layers.set(step, layer);
    const counted = judged.filter(({ verdict }) => verdict !== 'quarantined' && verdict !== 'skipped');
    if (!ok && !counted.some(({ verdict }) => verdict === 'failed')) layer.stepFailures++;
    for (const outcome of counted) {
      const test = nameOf(outcome);
      const key = `${step} ${test}`;
      const own = tests.get(key) ?? { step, test, tries: 0, first: 0, afterRerun: 0, reason: '' };
      tests.set(key, own);
      const first = outcome.verdict === 'passed' ? 0 : 1;
      const afterRerun = outcome.verdict === 'failed' ? 1 : 0;
      for (const count of [layer, own]) {
        count.tries++;
        count.first += first;
        count.afterRerun += afterRerun;
      }
      if (first > 0) own.reason = outcome.reason.trim().split('\n')[0] ?? '';
    }
  }
  for (const layer of layers.values()) layer.ok = isWithin(layer);
  const all = [...layers.values()];
  return {
    layers: all,
    tests: [...tests.values()]
      .filter(({ first }) => first > 0)
      .sort((a, b) => b.afterRerun - a.afterRerun || b.first - a.first),
    ok: all.every(({ ok }) => ok),
  };
}

function isWithin({ tries, first, afterRerun, stepFailures, budget }: LayerFlakes): boolean {
  return stepFailures === 0 && first <= budget.firstTries * tries && afterRerun <= budget.afterRerun * tries;
}

const percent = (share: number): string => `${Number((share * 100).toFixed(3))} %`;
const MOST_TESTS = 40;

/** The end of repeated runs, for people. */
export function flakeLines({ layers, tests }: Flakes): string[] {
  const lines = layers.map(({ step, tries, first, afterRerun, stepFailures, budget, ok }) =>
    [
      `${ok ? '✓' : '✗'} ${step.padEnd(9)}`,
      `${tries} tries`,
      `${first} failed at first${tries > 0 ? ` (${percent(first / tries)}, budget ${percent(budget.firstTries)})` : ''}`,
      `${afterRerun} after the rerun (budget ${percent(budget.afterRerun)})`,
      ...(stepFailures > 0 ? [`the step failed without a test ${stepFailures} times`] : []),
    ].join('  '),
  );
  if (tests.length === 0) return [...lines, 'no test has failed'];
  const rows = tests
    .slice(0, MOST_TESTS)
    .map(({ step, test, tries, first, afterRerun }) => [
      String(first),
      String(afterRerun),
      String(tries),
      step,
      test,
    ]);
  const head = ['first', 'after', 'of', 'step', 'test'];
  const widths = head.map((_, column) =>
    Math.max(...[head, ...rows].map((row) => (row[column] as string).length)),
  );
  const table = [head, ...rows].map((row) =>
    row
      .map((cell, column) =>
        column < 3 ? cell.padStart(widths[column] as number) : cell.padEnd(widths[column] as number),
      )
      .join('  ')
      .trimEnd(),
  );
  const more = tests.length > MOST_TESTS ? [`and ${tests.length - MOST_TESTS} more`] : [];
  return [...lines, '', ...table, ...more];
}
