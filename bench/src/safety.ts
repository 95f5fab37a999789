/** `pnpm bench safety`: what keeps the robot and others safe, in one run. */
import type { GuardedRun } from '@farpoint/robot-node/testing/guarded-run';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { benchOptions, option } from './bench-options.ts';
import { faultTimes, printFaults } from './faults.ts';
import { simulatedGuardMs } from './guard.ts';
import { type Drive, summaryOf, worldDrives } from './guard-runs.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import { distribution, rounded } from './stats.ts';
import { supervised } from './supervisor-cost.ts';

const USAGE = `pnpm bench safety [--runs 1000] [--seed 1] [--seconds 12] [--no-faults] [--json]

Simulated drives at full speed among walls, furniture and people (guard-runs has the details): contacts and false stops.
Times the obstacle guard for a cloud of 230,400 points, and a command through every guard and ramp. Then the fault table at
the real programs (faults), unless --no-faults.`;

const CLOUDS = 300;

export const bench: Bench = {
  name: 'safety',
  summary: 'contacts, false stops, cost of the guards, and from each fault to braking',
  usage: USAGE,
  async run(argv) {
    const {
      runs: count,
      seed,
      seconds,
      noFaults,
      json,
    } = benchOptions(argv, {
      runs: option.number(1000, { least: 1 }),
      seed: option.number(1),
      seconds: option.number(12, { least: 1 }),
      noFaults: option.flag,
    });
    const codec = await loadCodecFromDisk();
    const drives = worldDrives(codec);
    const commandMs: number[] = [];
    const times = { now: () => performance.now(), boundMs: [], around: supervised(commandMs) };
    const runs: GuardedRun[] = [];
    for (let i = 0; i < count; i++)
      runs.push(await (drives[i % drives.length] as Drive)(seed + i, seconds, times));
    const { contacts: seen, unseen, falseShare, metres } = summaryOf('all', runs);
    const contacts = seen + unseen;
    const guardMs = await simulatedGuardMs(codec, CLOUDS);
    const supervisorMs = rounded(distribution(commandMs), 4);
    console.log(
      `${count} runs, ${Math.round(metres)} m: ${contacts} contacts, ${(100 * falseShare).toFixed(2)} % false stops`,
    );
    printTable(
      ['', 'p50 ms', 'p95', 'p99', 'max'],
      [
        ['the guard, for a cloud of 230,400 points', ...distributionCells(guardMs)],
        ['a command, with all guards', ...distributionCells(supervisorMs)],
      ],
    );
    const faults = noFaults ? [] : await faultTimes();
    if (faults.length > 0) printFaults(faults);
    if (json)
      printJson({
        bench: 'safety',
        runs: count,
        contacts,
        falseStops: falseShare,
        guardMs,
        supervisorMs,
        faults,
      });
  },
};
