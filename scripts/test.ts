/**
 * `pnpm test`: runs all checks, in the order in which a fault is cheapest to find. Each step says what it does and
 * how long it took, and the end says what became of everything. What is missing on this machine is installed first; what
 * cannot be had is named.
 */
import { appendFileSync, mkdirSync, writeFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { root } from './lib/run.ts';
import { readWorkspaceFile } from './lib/workspace-files.ts';
import { CHANGED_MS } from './test/changed.ts';
import { countFlakes, flakeLines } from './test/flakes.ts';
import { groupStates } from './test/group-states.ts';
import { pinTo, startLoad } from './test/load.ts';
import { NEEDS } from './test/needs.ts';
import { nameOf } from './test/outcome.ts';
import { ProvenGroups } from './test/proven.ts';
import { provision } from './test/provision.ts';
import { readQuarantine } from './test/quarantine.ts';
import { type RepeatOptions, readRepeatOptions } from './test/repeat-options.ts';
import { runSteps } from './test/run-steps.ts';
import { TestSelection } from './test/selection.ts';
import { STEPS, type TestRun } from './test/steps.ts';
import { type StepSummary, summaryOf } from './test/summary.ts';
import { type Judged, MOST_FLAKY } from './test/verdict.ts';

const HELP = `pnpm test [--only STEP[,STEP…]] [--changed] [--all] [--pictures] [--repeat N] [--load N] [--cpus N]

${STEPS.map(({ name, what }) => `  ${name.padEnd(11)} ${what}`).join('\n')}

  --changed   what a change needs most, in a minute: lint, types, and the pure, scenario and page tests of which
              something has changed, in their packages or in what these use, since they last passed on this machine;
              the nearest to the change first. Again: those for which the minute had no room
  --all       also the groups of tests (tests/groups.yaml) that have passed here with the same inputs, and the long
              forms; with --changed: everything that has changed, however long it takes
  --pictures  browser tests save the pictures that only people look at (e2e/output)
  --repeat N  the steps N times; the end says which tests failed how often, and whether that is within the budget of
              their layer (docs/tests.md). Also appended to .farpoint/flakes.jsonl
  --load N    beside N busy programs of the same priority
  --cpus N    tests and busy programs on N cores only (Linux)`;

const { values } = parseArgs({
  options: {
    only: { type: 'string' },
    changed: { type: 'boolean', default: false },
    all: { type: 'boolean', default: false },
    pictures: { type: 'boolean', default: false },
    repeat: { type: 'string' },
    load: { type: 'string' },
    cpus: { type: 'string' },
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

const { repeat, load, cpus } = await repeatOptions();

if (values.all) process.env.FARPOINT_LONG_TESTS = '1';
if (values.pictures) process.env.FARPOINT_PICTURES = '1';
const began = performance.now();
const say = (line: string): void => console.log(`  ${line}`);
const selection = new TestSelection();
const limitMs = values.all ? Number.POSITIVE_INFINITY : CHANGED_MS;
const changed = values.changed
  ? selection.changed(
      STEPS.map(({ name }) => name),
      limitMs,
    )
  : null;
const chosen = STEPS.filter(
  ({ name }) => (only?.includes(name) ?? true) && (changed?.steps.includes(name) ?? true),
);
const quarantine = readQuarantine(readWorkspaceFile('tests/quarantine.yaml'));

const needs = NEEDS.filter(({ steps }) => chosen.some(({ name }) => steps.includes(name)));
if (needs.length > 0) console.log(`[0/${chosen.length}] what the tests use is here, or is installed`);
const missing = await provision(needs, say);
const proven = new ProvenGroups();
const hasGroups = chosen.some(({ name }) => name === 'stack' || name === 'rust');
const names = missing.map(({ name }) => name);
const groups = hasGroups ? await groupStates(proven, names, values.all) : [];
const filesOf = (step: string) => changed?.files.get(step);
const context: TestRun = { say, missing, groups, proven, quarantine, filesOf };

const busy = startLoad(load);
if (values.repeat !== undefined || values.load !== undefined) process.exit(await repeated());
const { summaries, counted } = await runSteps(chosen, context);
selection.keepPassed(summaries);

const all = summaries.flatMap(({ judged }) => judged);
const count = (...verdicts: Judged['verdict'][]) =>
  all.filter((test) => verdicts.includes(test.verdict)).length;
const tooFlaky = count('flaky') > MOST_FLAKY;
const isGreen = summaries.every(({ ok }) => ok) && counted.failed === 0 && !tooFlaky;
const lines = summaryOf(summaries, performance.now() - began, againWords, quarantine, Date.now());
mkdirSync(join(root, '.farpoint'), { recursive: true });
writeFileSync(join(root, '.farpoint', 'test-summary.txt'), `${lines.join('\n')}\n`);
console.log(`\n${lines.join('\n')}`);
if (changed !== null) console.log(changed.leftOut);
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

/** @returns the exit code: 1 if more fails than the layers' budgets allow */
async function repeated(): Promise<number> {
  const repetitions: StepSummary[][] = [];
  for (let time = 1; time <= repeat; time++)
    repetitions.push((await runSteps(chosen, context, `${time} of ${repeat} `)).summaries);
  busy.end();
  const flakes = countFlakes(repetitions);
  const what = { at: new Date().toISOString(), repeat, load, cpus, ...flakes };
  mkdirSync(join(root, '.farpoint'), { recursive: true });
  appendFileSync(join(root, '.farpoint', 'flakes.jsonl'), `${JSON.stringify(what)}\n`);
  const beside = `${repeat} × beside ${load} × busy${cpus === null ? '' : `, cores: ${cpus}`}`;
  console.log(`\n${[beside, ...flakeLines(flakes)].join('\n')}`);
  return flakes.ok ? 0 : 1;
}

async function repeatOptions(): Promise<RepeatOptions> {
  try {
    const options = readRepeatOptions(values, availableParallelism());
    if (options.cpus !== null) await pinTo(options.cpus);
    return options;
  } catch (error) {
    console.error(error instanceof Error ? error.message : error);
    process.exit(2);
  }
}

/** The command that repeats one test. */
function againWords(step: string, test: Judged): string {
  if (step === 'page' || step === 'smoke' || step === 'firefox') {
    return `pnpm --dir e2e exec playwright test --project=${step} ${test.file.replace('e2e/', '')}:${test.line ?? ''}`;
  }
  return `pnpm exec vitest run ${nameOf({ ...test, title: '' })}`;
}
