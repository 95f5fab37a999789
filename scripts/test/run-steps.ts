/** Runs steps one after the other, and says of each what became of it. */
import { addTallies, emptyTally, type Tally } from '../lib/tally.ts';
import type { Step, TestRun } from './steps.ts';
import type { StepSummary } from './summary.ts';

const LAST_LINES = 12;

export interface StepsResult {
  summaries: StepSummary[];
  /** Of tests of which there is no report. */
  counted: Tally;
}

/** @param around what is said before the number of a step, such as that of a repetition */
export async function runSteps(steps: readonly Step[], context: TestRun, around = ''): Promise<StepsResult> {
  const summaries: StepSummary[] = [];
  let counted = emptyTally;
  for (const [index, step] of steps.entries()) {
    console.log(`${around}[${index + 1}/${steps.length}] ${step.what}`);
    const started = performance.now();
    const result = await step.run(context);
    const ms = performance.now() - started;
    const { ok, judged = [], failure = null, notTested = [] } = result;
    if (result.tally !== undefined) counted = addTallies(counted, result.tally);
    if (failure !== null) console.log(failure);
    for (const what of notTested) context.say(`– not tested here: ${what}`);
    const seconds = (ms / 1000).toFixed(1);
    console.log(ok ? `  ✓ ${seconds} s` : `  ✗ failed after ${seconds} s`);
    const isOfTest = judged.some(({ verdict }) => verdict === 'failed');
    summaries.push({
      name: step.name,
      ms,
      ok,
      judged,
      notTested,
      proven: result.proven ?? [],
      // The end of a log is what its reader looks at first.
      failure:
        ok || (isOfTest && failure === null)
          ? null
          : (failure ?? '').split('\n').slice(-LAST_LINES).join('\n'),
    });
  }
  return { summaries, counted };
}
