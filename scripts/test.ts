/**
 * `pnpm test`: runs all checks, in the order in which a fault is cheapest to find. Each step says what it does and
 * how long it took. A step that cannot run says what is missing, and which command fixes that.
 */
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { CHROMIUM_REMEDY } from '@farpoint/local-stack';
import * as dds from '../packages/dds/src/build.ts';
import * as gpio from '../packages/gpio/src/build.ts';
import * as sharedMemory from '../packages/shared-memory/src/build.ts';
import * as sound from '../packages/sound/src/build.ts';
import * as systemd from '../packages/systemd/src/build.ts';
import * as udpBatch from '../packages/udp-batch/src/build.ts';
import * as video from '../packages/video/src/build.ts';
import { auditDependencies } from './lib/audit-dependencies.ts';
import { bundledPrograms, bundlePrograms } from './lib/bundle-programs.ts';
import { ensureChromium } from './lib/ensure-chromium.ts';
import { ensureCycloneDds, ensureDdsPeers } from './lib/ensure-dds.ts';
import { ensureFirefox } from './lib/ensure-firefox.ts';
import { ensureGStreamer } from './lib/ensure-gstreamer.ts';
import { ensureJanus } from './lib/ensure-janus.ts';
import { ensureNumpy } from './lib/ensure-numpy.ts';
import { ensurePrometheus } from './lib/ensure-prometheus.ts';
import { ensureRos1 } from './lib/ensure-ros1.ts';
import { ensureTurnServer } from './lib/ensure-turn-server.ts';
import { failedTests, failuresOf } from './lib/failures.ts';
import { compileCache, root, run } from './lib/run.ts';
import { addTallies, emptyTally, type Tally, tallyCargo, tallyPlaywright, tallyVitest } from './lib/tally.ts';
import { testRust } from './lib/test-rust.ts';
import { writeBill } from './lib/write-bill.ts';

interface StepResult {
  ok: boolean;
  /** Why the step did not run, with the remedy. If `CI` is set, the whole run then fails. */
  skipped?: string;
  /** Why it could not run although nothing is missing here: a service elsewhere does not answer. Fails no run. */
  unreachable?: string;
  tally?: Tally;
  output?: string;
  /** Whether `output` was on the screen while the step ran. */
  echoed?: boolean;
}

interface Step {
  name: string;
  what: string;
  run: () => Promise<StepResult>;
}

/** What takes long and seldom fails alone. */
const LONG_PARTS =
  'builds the WASM from its sources, and runs the long tests in browsers (a quarter of an hour more)';

const say = (line: string): void => console.log(`  ${line}`);

async function runQuietly(program: string, args: string[]): Promise<StepResult> {
  const { code, output } = await run(program, args);
  return { ok: code === 0, output };
}

/** @param project name of one or, with `*`, several of the projects in vitest.config.ts */
async function runVitest(project: 'pure' | 'stack*'): Promise<StepResult> {
  const { code, output } = await run('vitest', ['run', '--project', project], { echo: true });
  return { ok: code === 0, tally: tallyVitest(output), output, echoed: true };
}

async function runPlaywright(project: 'chromium' | 'firefox'): Promise<StepResult> {
  const args = ['--dir', 'e2e', 'exec', 'playwright', 'test', '--project', project];
  const { code, output } = await run('pnpm', args, { echo: true });
  return { ok: code === 0, tally: tallyPlaywright(output), output, echoed: true };
}

const steps: Step[] = [
  { name: 'lint', what: 'format and lint (biome)', run: () => runQuietly('biome', ['check', '.']) },
  {
    name: 'types',
    what: 'type check (tsc)',
    run: () => runQuietly('pnpm', ['run', 'typecheck']),
  },
  {
    name: 'supply',
    what: 'bill of materials (CycloneDX), and advisories on production dependencies (pnpm audit)',
    run: async () => {
      await writeBill(join(root, '.farpoint', 'farpoint.cdx.json'));
      const outcome = await auditDependencies();
      if (outcome.made) return { ok: outcome.faults.length === 0, output: outcome.faults.join('\n') };
      return { ok: true, unreachable: `dependency audit: ${outcome.reason}` };
    },
  },
  {
    name: 'native',
    what: 'native addons build from source (node-gyp)',
    run: async () => {
      await ensureCycloneDds(say);
      await ensureGStreamer(say);
      const left: string[] = [];
      for (const [what, { buildAddon, BUILD_REMEDY }] of [
        ['shared memory', sharedMemory],
        ['a stop by GPIO', gpio],
        ['the systemd unit', systemd],
        ['sending many packets by one system call', udpBatch],
        ['ROS 2', dds],
        ['camera video', video],
        ['sound', sound],
      ] as const) {
        const { ok, output } = buildAddon();
        if (ok) continue;
        say(output.trim().split('\n').slice(-20).join('\n  '));
        left.push(`${what} is not tested; ${BUILD_REMEDY}`);
      }
      await ensureNumpy(say);
      if (dds.buildAddon().ok) await ensureDdsPeers(say);
      return left.length === 0 ? { ok: true } : { ok: true, skipped: left.join('; ') };
    },
  },
  {
    name: 'pure',
    what: 'unit tests without processes, threads or sockets (vitest)',
    run: () => runVitest('pure'),
  },
  {
    name: 'rust',
    what: 'Rust: committed WASM is fresh, format, clippy, tests',
    run: async () => {
      const result = await testRust(say, { rebuild: values.all });
      return { ...result, tally: tallyCargo(result.output) };
    },
  },
  {
    name: 'programs',
    what: 'programs in one file each, which the tests start hundreds of times (esbuild)',
    run: async () => {
      await bundlePrograms(bundledPrograms);
      process.env.FARPOINT_PROGRAMS = bundledPrograms;
      return { ok: true };
    },
  },
  {
    name: 'stack',
    what: 'unit tests with processes, threads and sockets (vitest)',
    run: async () => {
      await ensureRos1(say);
      await ensureJanus(say);
      await ensurePrometheus(say);
      return runVitest('stack*');
    },
  },
  { name: 'build', what: 'build what is deployed', run: () => runQuietly('node', ['scripts/build.ts']) },
  {
    name: 'e2e',
    what: 'end to end in Chromium (playwright)',
    run: async () => {
      if ((await ensureChromium(say)) === null) {
        return { ok: false, output: `no Chromium, and it could not be installed; run: ${CHROMIUM_REMEDY}` };
      }
      await ensureTurnServer(say);
      await ensureJanus(say);
      return runPlaywright('chromium');
    },
  },
  {
    name: 'firefox',
    what: 'end to end in Firefox (WebDriver BiDi)',
    run: async () => {
      const missing = await ensureFirefox(say);
      return missing === null ? runPlaywright('firefox') : { ok: true, skipped: missing };
    },
  },
];

const { values } = parseArgs({
  options: {
    only: { type: 'string' },
    all: { type: 'boolean', default: false },
    help: { type: 'boolean', short: 'h' },
  },
});

if (values.help) {
  console.log('pnpm test [--only STEP[,STEP…]] [--all]\n');
  for (const step of steps) console.log(`  ${step.name.padEnd(8)} ${step.what}`);
  console.log(`\n  --all    also ${LONG_PARTS}`);
  process.exit(0);
}

const only = values.only?.split(',');
const unknown = only?.find((name) => !steps.some((step) => step.name === name));
if (unknown !== undefined) {
  console.error(
    `--only: there is no step ${unknown}; the steps are ${steps.map((step) => step.name).join(', ')}`,
  );
  process.exit(2);
}

process.env.NODE_COMPILE_CACHE ??= compileCache;
if (values.all) Object.assign(process.env, { FARPOINT_LONG_TESTS: '1', FARPOINT_SCREENSHOTS: '1' });
let total = emptyTally;
const faults: string[] = [];
const failedNames: string[] = [];
const chosen = steps.filter((step) => only === undefined || only.includes(step.name));
for (const [index, step] of chosen.entries()) {
  console.log(`[${index + 1}/${chosen.length}] ${step.what}`);
  const started = performance.now();
  const result = await step.run();
  const seconds = ((performance.now() - started) / 1000).toFixed(1);
  if (result.tally !== undefined) total = addTallies(total, result.tally);
  if (!result.ok) {
    if (result.output !== undefined && !result.echoed) console.log(result.output);
    // Said again below: a reader of a long log looks at its end first.
    const { output = '' } = result;
    faults.push(`${step.name}: failed\n${failuresOf(output)}`);
    failedNames.push(...failedTests(output));
    console.log(`  ✗ failed after ${seconds} s`);
  } else if (result.unreachable !== undefined) {
    console.log(`  – skipped: ${result.unreachable}`);
  } else if (result.skipped !== undefined) {
    console.log(`  – partly skipped: ${result.skipped}`);
    if (process.env.CI) faults.push(`${step.name}: ${result.skipped}`);
  } else {
    console.log(`  ✓ ${seconds} s`);
  }
}

if (!values.all && only === undefined) console.log(`\nleft out: pnpm test --all also ${LONG_PARTS}`);
// A step that fails without a failing test (a lint, a build) counts as one failure.
const failed = Math.max(total.failed, faults.length);
for (const fault of faults) console.log(`\n${fault}`);
if (failedNames.length > 0) console.log(`\nfailed tests:\n  ${failedNames.join('\n  ')}`);
if (only?.join() === 'pure' && faults.length === 0) {
  console.log(
    'next: pnpm test --only lint,types,stack, then pnpm test for everything; one package: see CONTRIBUTING.md',
  );
}
console.log(
  `\n${total.passed} passed, ${failed} failed${total.skipped > 0 ? `, ${total.skipped} skipped` : ''}`,
);
process.exit(faults.length === 0 && total.failed === 0 ? 0 : 1);
