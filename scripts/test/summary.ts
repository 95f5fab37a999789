/** The end of a run, for people: layer by layer what passed, and of each failure what to know and to do next. Pure. */
import { nameOf } from './outcome.ts';
import { daysLeft, type Quarantined } from './quarantine.ts';
import { type Judged, MOST_FLAKY } from './verdict.ts';

/** What became of a step. */
export interface StepSummary {
  name: string;
  ms: number;
  ok: boolean;
  /** Tests by their verdicts, where the step has a report of them. */
  judged: readonly Judged[];
  /** Last lines of a step that failed without a test that failed. */
  failure: string | null;
  /** What could not be tested on this machine, and why. */
  notTested: readonly string[];
  /** Groups of tests that did not run because they have passed before, and when. */
  proven: readonly string[];
}

const MOST_LINES = 40;
const MOST_FAILURES = 8;
const MOST_REASON_LINES = 3;
const WIDTH = 150;
const SLOWEST = 5;

/**
 * At most 40 lines.
 *
 * @param again the command that repeats one test @param nowMs since 1970
 */
export function summaryOf(
  steps: readonly StepSummary[],
  totalMs: number,
  again: (step: string, test: Judged) => string,
  quarantine: readonly Quarantined[],
  nowMs: number,
): string[] {
  const judged = steps.flatMap((step) => step.judged.map((test) => ({ step: step.name, test })));
  const of = (verdict: Judged['verdict']) => judged.filter(({ test }) => test.verdict === verdict);
  const lines = wrapped(steps.map(wordsOf), durationWords(totalMs));
  const failed = of('failed');
  for (const { step, test } of failed.slice(0, MOST_FAILURES)) lines.push(...failureLines(step, test, again));
  if (failed.length > MOST_FAILURES) lines.push(`FAILED  and ${failed.length - MOST_FAILURES} more`);
  for (const { name, failure } of steps)
    if (failure !== null) lines.push(`FAILED  ${name}`, ...indented(failure));
  const flaky = of('flaky');
  for (const { step, test } of flaky)
    lines.push(`flaky (passed ${test.alone.length}/${test.alone.length} alone)  ${step}  ${nameOf(test)}`);
  if (flaky.length > MOST_FLAKY)
    lines.push(
      `FAILED  ${flaky.length} flaky tests: more than ${MOST_FLAKY} are a fault of product or machine`,
    );
  for (const { step, test } of of('quarantined')) {
    const entry = quarantine.find((each) => each.test === nameOf(test));
    const left = entry === undefined ? 0 : daysLeft(entry, nowMs);
    const until = left < 0 ? `EXPIRED ${-left} days ago: mend it or delete it` : `${left} days left`;
    lines.push(`quarantined (${until})  ${step}  ${nameOf(test)}: ${test.status}`);
  }
  for (const { notTested } of steps) for (const what of notTested) lines.push(`not tested here  ${what}`);
  const proven = steps.flatMap((step) => step.proven);
  if (proven.length > 0) lines.push(`passed before, with the same inputs  ${proven.join(', ')}`);
  const slowest = judged.toSorted((a, b) => b.test.ms - a.test.ms).slice(0, SLOWEST);
  const seconds = (ms: number) => `${Math.round(ms / 1000)} s`;
  if (slowest.length > 0)
    lines.push(
      `slowest  ${slowest.map(({ test }) => `${test.file.split('/').at(-1)}${test.line === null ? '' : `:${test.line}`} ${seconds(test.ms)}`).join(' · ')}`,
    );
  const cut = lines.map((line) => (line.length > WIDTH ? `${line.slice(0, WIDTH - 1)}…` : line));
  return cut.length > MOST_LINES ? [...cut.slice(0, MOST_LINES - 1), '…'] : cut;
}

/** As many words to a line as there is room for, separated by more than a space. */
function wrapped(words: readonly string[], first: string): string[] {
  const lines = [first];
  for (const word of words) {
    const longer = `${lines.at(-1)}   ${word}`;
    if (longer.length <= WIDTH) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines;
}

function wordsOf({ name, ms, ok, judged, notTested }: StepSummary): string {
  const flaky = judged.filter(({ verdict }) => verdict === 'flaky').length;
  const notes = [...(flaky > 0 ? [`${flaky} flaky`] : []), ...(notTested.length > 0 ? ['in part'] : [])];
  return `${name} ${ok ? '✓' : '✗'} ${Math.round(ms / 1000)}${notes.length > 0 ? ` (${notes.join(', ')})` : ''}`;
}

function failureLines(step: string, test: Judged, again: (step: string, test: Judged) => string): string[] {
  const alone = test.alone.map(({ status }) => (status === 'passed' ? 'passed' : 'failed'));
  const left = test.alone.flatMap(({ attachments }) => attachments);
  return [
    `FAILED  ${step}  ${nameOf(test)}${test.line === null ? '' : ` (line ${test.line})`}`,
    ...indented(test.reason),
    `        ${alone.length === 0 ? 'not run again' : `alone: ${alone.join(', ')}`}; again: ${again(step, test)}`,
    ...(left.length === 0 ? [] : [`        left behind: ${left.slice(0, 3).join(' ')}`]),
  ];
}

function indented(text: string): string[] {
  const lines = text.split('\n').filter((line) => line.trim() !== '');
  return lines.slice(0, MOST_REASON_LINES).map((line) => `        ${line.trim()}`);
}

export function durationWords(ms: number): string {
  const seconds = Math.round(ms / 1000);
  return seconds < 60 ? `${seconds} s` : `${Math.floor(seconds / 60)} min ${seconds % 60} s`;
}
