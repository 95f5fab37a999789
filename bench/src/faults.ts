/** `pnpm bench faults`: what goes wrong while a robot is driven, and how soon it brakes. */
import { spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { processFolder } from '@farpoint/local-stack';
import { type FaultTime, TIMES_FILE } from '@farpoint/robot-node/testing/fault-times';
import { benchOptions } from './bench-options.ts';
import { type Bench, printJson, printTable } from './report.ts';

const USAGE = `pnpm bench faults [--json]

Runs the fault table of the tests (about 3 minutes): the real robot program is driven with the grip held, one thing goes
wrong, and the time until the wheels are told less is measured and judged. The tests judge these times in virtual time, and
run only a few rows at the real programs. Fails if one is longer than its limit.`;

const root = join(import.meta.dirname, '..', '..');

/** @throws Error if a test of the table failed for another reason than its time, or nothing was measured */
export async function faultTimes(): Promise<FaultTime[]> {
  const folder = processFolder();
  const file = join(folder, 'times.json');
  const vitest = join(root, 'node_modules', 'vitest', 'vitest.mjs');
  const args = ['run', '--project', 'stack-alone', 'apps/robot-node/src/fault-table.stack.test.ts'];
  const child = spawn(process.execPath, [vitest, ...args], {
    cwd: root,
    env: { ...process.env, [TIMES_FILE]: file, FARPOINT_LONG_TESTS: '1' },
    // The JSON goes to standard output alone.
    stdio: ['ignore', 2, 2],
  });
  const code = await new Promise<number | null>((resolve, reject) => {
    child.once('error', reject);
    child.once('exit', resolve);
  });
  if (code !== 0) throw new Error('a test of the fault table failed; see above');
  return JSON.parse(readFileSync(file, 'utf8')) as FaultTime[];
}

export function printFaults(faults: readonly FaultTime[]): void {
  printTable(
    ['fault', 'braking after, ms', 'limit, ms', ''],
    faults.map(({ fault, brakingAfterMs, limitMs, ok }) => [
      fault,
      Math.round(brakingAfterMs),
      Math.round(limitMs),
      ok ? '' : 'LATE',
    ]),
  );
}

export const bench: Bench = {
  name: 'faults',
  summary: 'faults at the real programs while driving: from the cause to braking',
  usage: USAGE,
  async run(argv) {
    const { json } = benchOptions(argv, {});
    const faults = await faultTimes();
    printFaults(faults);
    if (json) printJson({ faults });
    const late = faults.filter(({ ok }) => !ok);
    if (late.length > 0) throw new Error(`${late.length} of ${faults.length} braked too late`);
  },
};
