/**
 * `pnpm test`: runs all checks, in the order in which a fault is cheapest to find. Each step says what it does and
 * how long it took, and the end says what became of everything. What is missing on this machine is installed first; what
 * cannot be had is named.
 */
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { root } from './lib/run.ts';
import { addTallies, emptyTally } from './lib/tally.ts';
import { readWorkspaceFile } from './lib/workspace-files.ts';
import { groupStates } from './test/group-states.ts';
import { NEEDS } from './test/needs.ts';
import { nameOf } from './test/outcome.ts';
import { ProvenGroups } from './test/proven.ts';
import { provision } from './test/provision.ts';
import { readQuarantine } from './test/quarantine.ts';
import { STEPS, type TestRun } from './test/steps.ts';
import { type StepSummary, summaryOf } from './test/summary.ts';
import { type Judged, MOST_FLAKY } from './test/verdict.ts';

const HELP = `pnpm test [--only STEP[,STEP…]] [--all] [--pictures]

${STEPS.map(({ name, what }) => `  ${name.padEnd(11)} ${what}`).join('\n')}

  --all       also the groups of tests (tests/groups.yaml) that have passed here with the same inputs, and the long forms
  --pictures  browser tests save the pictures that only people look at (e2e/output)`;

const { values } = parseArgs({
  options: {
    only: { type: 'string' },
    all: { type: 'boolean', default: false },
    pictures: { type: 'boolean', default: false },
    help: { type: 'boolean', short: 'h' },
  },
});

if (values.help) {
  console.log(HELP);
  process.exit(0);
}

const only = values.only?.split(',');
const unknown = only?.find((name) => !STEPS.some((step) => step.name === name));
if (unknown !== undefined) {
  const names = STEPS.map(({ name }) => name).join(', ');
  console.error(`--only: there is no step ${unknown}; the steps are ${names}`);
  process.exit(2);
}

if (values.all) process.env.FARPOINT_LONG_TESTS = '1';
if (values.pictures) process.env.FARPOINT_PICTURES = '1';
const began = performance.now();
const say = (line: string): void => console.log(`  ${line}`);
const chosen = STEPS.filter(({ name }) => only === undefined || only.includes(name));
const quarantine = readQuarantine(readWorkspaceFile('tests/quarantine.yaml'));

const needs = NEEDS.filter(({ steps }) => chosen.some(({ name }) => steps.includes(name)));
if (needs.length > 0) console.log(`[0/${chosen.length}] what the tests use is here, or is installed`);
const missing = await provision(needs, say);
const proven = new ProvenGroups();
const hasGroups = chosen.some(({ name }) => name === 'stack' || name === 'rust');
const names = missing.map(({ name }) => name);
const groups = hasGroups ? await groupStates(proven, names, values.all) : [];
const context: TestRun = { say, missing, groups, proven, quarantine };

const summaries: StepSummary[] = [];
let counted = emptyTally;
for (const [index, step] of chosen.entries()) {
  console.log(`[${index + 1}/${chosen.length}] ${step.what}`);
  const started = performance.now();
  const result = await step.run(context);
  const ms = performance.now() - started;
  const { ok, judged = [], failure = null, notTested = [] } = result;
  if (result.tally !== undefined) counted = addTallies(counted, result.tally);
  if (failure !== null) console.log(failure);
  for (const what of notTested) say(`– not tested here: ${what}`);
  const seconds = (ms / 1000).toFixed(1);
  console.log(ok ? `  ✓ ${seconds} s` : `  ✗ failed after ${seconds} s`);
  const isOfTest = judged.some(({ verdict }) => verdict === 'failed');
  summaries.push({
    ...{ name: step.name, ms, ok, judged, notTested, proven: result.proven ?? [] },
    // The end of a log is what its reader looks at first.
    failure: ok || (isOfTest && failure === null) ? null : (failure ?? '').split('\n').slice(-12).join('\n'),
  });
}

const all = summaries.flatMap(({ judged }) => judged);
const count = (...verdicts: Judged['verdict'][]) =>
  all.filter((test) => verdicts.includes(test.verdict)).length;
const tooFlaky = count('flaky') > MOST_FLAKY;
const isGreen = summaries.every(({ ok }) => ok) && counted.failed === 0 && !tooFlaky;
const lines = summaryOf(summaries, performance.now() - began, againWords, quarantine, Date.now());
mkdirSync(join(root, '.farpoint'), { recursive: true });
writeFileSync(join(root, '.farpoint', 'test-summary.txt'), `${lines.join('\n')}\n`);
console.log(`\n${lines.join('\n')}`);
if (only?.join() === 'pure' && isGreen)
  console.log(
    'next: pnpm test --only lint,types,stack, then pnpm test for everything; one package: see CONTRIBUTING.md',
  );

// A step that fails without a failing test (a lint, a build) counts as one failure.
const failures = Math.max(
  count('failed') + counted.failed,
  summaries.filter(({ ok }) => !ok).length + (tooFlaky ? 1 : 0),
);
const passed = count('passed', 'flaky') + counted.passed;
const skipped = count('skipped', 'quarantined') + counted.skipped;
console.log(`\n${passed} passed, ${failures} failed${skipped > 0 ? `, ${skipped} skipped` : ''}`);
process.exit(isGreen ? 0 : 1);

/** The command that repeats one test. */
function againWords(step: string, test: Judged): string {
  if (step === 'e2e' || step === 'firefox') {
    const project = step === 'e2e' ? 'chromium' : 'firefox';
    return `pnpm --dir e2e exec playwright test --project=${project} ${test.file.replace('e2e/', '')}:${test.line ?? ''}`;
  }
  return `pnpm exec vitest run ${nameOf({ ...test, title: '' })}`;
}
