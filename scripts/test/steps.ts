/** The steps of `pnpm test`, in the order in which a fault is cheapest to find. */
import { join } from 'node:path';
import * as dds from '../../packages/dds/src/build.ts';
import * as gpio from '../../packages/gpio/src/build.ts';
import * as sharedMemory from '../../packages/shared-memory/src/build.ts';
import * as sound from '../../packages/sound/src/build.ts';
import * as systemd from '../../packages/systemd/src/build.ts';
import * as udpBatch from '../../packages/udp-batch/src/build.ts';
import * as video from '../../packages/video/src/build.ts';
import { auditDependencies } from '../lib/audit-dependencies.ts';
import { root, run } from '../lib/run.ts';
import { type Tally, tallyCargo } from '../lib/tally.ts';
import { testRust } from '../lib/test-rust.ts';
import { writeBill } from '../lib/write-bill.ts';
import type { GroupState } from './group-states.ts';
import { NEEDS, type Need } from './needs.ts';
import type { ProvenGroups } from './proven.ts';
import type { Quarantined } from './quarantine.ts';
import { runPlaywright, runVitest, type SuiteResult } from './run-suites.ts';
import type { Judged } from './verdict.ts';
import { warmPrograms } from './warm-programs.ts';

export interface StepResult {
  ok: boolean;
  judged?: readonly Judged[];
  /** Counts of tests of which there is no report. */
  tally?: Tally;
  /** Why it failed, where no test says so. */
  failure?: string | null;
  /** What could not be tested on this machine, and why. */
  notTested?: readonly string[];
  /** Groups that have passed before with the same inputs and tools, and when. */
  proven?: readonly string[];
}

/** What is known before the first step. */
export interface TestRun {
  say(line: string): void;
  /** What is not on this machine and could not be installed. */
  missing: readonly Need[];
  groups: readonly GroupState[];
  proven: ProvenGroups;
  quarantine: readonly Quarantined[];
  /** The only files of tests that a step has to run; `undefined`: all. */
  filesOf(step: string): readonly string[] | undefined;
}

export interface Step {
  name: string;
  what: string;
  run(context: TestRun): Promise<StepResult>;
}

const ADDONS = [
  { what: 'shared memory', needs: ['compiler'], ...sharedMemory },
  { what: 'a stop by GPIO', needs: ['compiler'], ...gpio },
  { what: 'the systemd unit', needs: ['compiler'], ...systemd },
  { what: 'sending many packets by one system call', needs: ['compiler'], ...udpBatch },
  { what: 'ROS 2', needs: ['compiler', 'cyclonedds'], ...dds },
  { what: 'camera video', needs: ['compiler', 'gstreamer'], ...video },
  { what: 'sound', needs: ['compiler', 'gstreamer'], ...sound },
];

async function runQuietly(program: string, args: string[]): Promise<StepResult> {
  const { code, output } = await run(program, args);
  return code === 0 ? { ok: true } : { ok: false, failure: output };
}

function ofSuite({ judged, failure }: SuiteResult): StepResult {
  return { ok: failure === null && judged.every(({ verdict }) => verdict !== 'failed'), judged, failure };
}

/** What of a step is not tested, because something is missing. */
function untested(step: string, { missing }: TestRun): string[] {
  return missing.filter(({ steps }) => steps.includes(step)).flatMap(({ without }) => without ?? []);
}

function buildAddons(context: TestRun): StepResult {
  const notTested: string[] = [];
  const faults: string[] = [];
  for (const { what, needs, buildAddon, BUILD_REMEDY } of ADDONS) {
    const { ok, output } = buildAddon();
    if (ok) continue;
    const isExcused =
      process.platform !== 'linux' || context.missing.some(({ name }) => needs.includes(name));
    if (isExcused) notTested.push(`${what}: ${BUILD_REMEDY}`);
    else faults.push(`${what} does not build\n${output.trim().split('\n').slice(-20).join('\n')}`);
  }
  return {
    ok: faults.length === 0,
    failure: faults.length === 0 ? null : faults.join('\n'),
    notTested: [...notTested, ...untested('native', context)],
  };
}

async function runRust(context: TestRun): Promise<StepResult> {
  const state = context.groups.find(({ group }) => group.name === 'rust');
  const isProven = state !== undefined && state.provenAt !== null;
  const result = await testRust(context.say, { onlyHashes: isProven });
  const notTested = result.skipped === undefined ? [] : [result.skipped];
  if (result.ok && !isProven && state !== undefined && notTested.length === 0) keep(state, context);
  return {
    ok: result.ok,
    failure: result.ok ? null : result.output,
    tally: tallyCargo(result.output),
    notTested,
    proven: isProven ? [provenWords(state)] : [],
  };
}

async function runStack(context: TestRun): Promise<StepResult> {
  await warmPrograms(context.say);
  const groups = context.groups.filter(({ group }) => group.tests.length > 0);
  const passed = groups.filter(({ provenAt }) => provenAt !== null);
  const result = ofSuite(
    await runVitest({
      project: 'stack*',
      without: passed.flatMap(({ group }) => group.tests),
      again: true,
      quarantine: context.quarantine,
    }),
  );
  const judged = result.judged ?? [];
  for (const state of groups) {
    if (state.provenAt !== null || state.missing.length > 0) continue;
    const files = state.group.tests.map((file) => judged.filter((test) => test.file === file));
    const isWhole = files.every(
      (tests) =>
        tests.some(({ verdict }) => verdict === 'passed' || verdict === 'flaky') &&
        tests.every(({ verdict }) => verdict !== 'failed'),
    );
    if (isWhole) keep(state, context);
  }
  const changed = groups.filter(({ missing, hasChanged }) => missing.length > 0 && hasChanged);
  const failures = [
    ...(result.failure === null || result.failure === undefined ? [] : [result.failure]),
    ...changed.map(
      ({ group, missing }) =>
        `${group.name} (${group.what}) has changed and cannot be tested here: ${missing.join(', ')} is missing`,
    ),
  ];
  return {
    ...result,
    ok: result.ok && changed.length === 0,
    failure: failures.length === 0 ? null : failures.join('\n'),
    notTested: untested('stack', context),
    proven: passed.map(provenWords),
  };
}

function keep({ group, inputs, tools }: GroupState, { proven }: TestRun): void {
  proven.keep(group.name, { inputs, tools, at: new Date().toISOString() });
}

function provenWords({ group, provenAt }: GroupState): string {
  return `${group.name} (${provenAt?.slice(0, 10)})`;
}

/** Steps that are projects of e2e/playwright.config.ts, and the browsers that they need. */
const BROWSERS = { page: 'chromium', smoke: 'chromium', firefox: 'firefox' } as const;

async function runBrowser(step: keyof typeof BROWSERS, context: TestRun): Promise<StepResult> {
  const notTested = untested(step, context);
  const browser = BROWSERS[step];
  if (context.missing.some(({ name }) => name === browser)) {
    // Without Chromium nothing says that the page works.
    if (browser === 'firefox') return { ok: true, notTested };
    return { ok: false, failure: `not tested: ${NEEDS.find(({ name }) => name === browser)?.without}` };
  }
  // Its tests have neither a program nor real time that could excuse a failure.
  const again = step !== 'page';
  if (again) await warmPrograms(context.say);
  const { quarantine } = context;
  const files = context.filesOf(step);
  return { ...ofSuite(await runPlaywright({ project: step, files, again, quarantine })), notTested };
}

export const STEPS: readonly Step[] = [
  { name: 'lint', what: 'format and lint (biome)', run: () => runQuietly('biome', ['check', '.']) },
  { name: 'types', what: 'type check (tsc)', run: () => runQuietly('pnpm', ['run', 'typecheck']) },
  {
    name: 'supply',
    what: 'bill of materials (CycloneDX), and advisories on production dependencies (pnpm audit)',
    run: async () => {
      await writeBill(join(root, '.farpoint', 'farpoint.cdx.json'));
      const outcome = await auditDependencies();
      if (!outcome.made) return { ok: true, notTested: [`dependency audit: ${outcome.reason}`] };
      const ok = outcome.faults.length === 0;
      return { ok, failure: ok ? null : outcome.faults.join('\n') };
    },
  },
  {
    name: 'native',
    what: 'native addons build from source (node-gyp)',
    run: (context) => Promise.resolve(buildAddons(context)),
  },
  {
    name: 'pure',
    what: 'unit tests without processes, threads or sockets (vitest)',
    run: async ({ filesOf }) =>
      ofSuite(await runVitest({ project: 'pure', files: filesOf('pure'), again: false })),
  },
  {
    name: 'scenario',
    what: 'operators, a link and a robot in virtual time (vitest)',
    run: async ({ filesOf }) =>
      ofSuite(await runVitest({ project: 'scenario', files: filesOf('scenario'), again: false })),
  },
  {
    name: 'rust',
    what: 'Rust: committed WASM is fresh, rebuilds from source, format, clippy, tests',
    run: runRust,
  },
  { name: 'build', what: 'build what is deployed', run: () => runQuietly('node', ['scripts/build.ts']) },
  {
    name: 'page',
    what: 'the page in Chromium on a scripted link, with a clock of its own (playwright)',
    run: (context) => runBrowser('page', context),
  },
  { name: 'stack', what: 'unit tests with processes, threads and sockets (vitest)', run: runStack },
  {
    name: 'smoke',
    what: 'the real programs with a real Chromium (playwright)',
    run: (context) => runBrowser('smoke', context),
  },
  {
    name: 'firefox',
    what: 'the same with a real Firefox (WebDriver BiDi)',
    run: (context) => runBrowser('firefox', context),
  },
];
