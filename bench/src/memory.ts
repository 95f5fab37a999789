/** `pnpm bench memory`: a kernel benchmark of the remembered world, against what is truly there. */

import { benchOptions, option } from './bench-options.ts';
import { rememberedDrive } from './memory/remembered-drive.ts';
import { type Bench, printJson, printTable } from './report.ts';
import { distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench memory [--seconds 60] [--seed 1] [--json]

Kernel benchmark: a simulated robot drives through an office with walking people and remembers what its depth camera
sees, four times a second. remembered is the share of the true surfaces seen from within 5.5 m (without people) that
have something remembered within 0.1 m, distanceM how far what is remembered is from any true surface, ghosts the share
that is farther than 0.25 m, workMs the time of a key frame in the worker.`;

export const bench: Bench = {
  name: 'memory',
  summary: 'kernel: how much of the true world is remembered, how truly, and at what cost',
  usage: USAGE,
  async run(argv) {
    const { seconds, seed, json } = benchOptions(argv, {
      seconds: option.number(60, { least: 5 }),
      seed: option.number(1),
    });
    const { distancesM, workMs, remembered, ghosts, surfels, bytes } = await rememberedDrive(seconds, seed);
    const result = {
      remembered: share(remembered),
      ghosts: share(ghosts),
      surfels,
      megabytes: Math.round(bytes / 1e5) / 10,
      distanceM: rounded(distribution(distancesM), 4),
      workMs: rounded(distribution(workMs), 2),
    };
    printTable(
      ['remembered', 'ghosts', 'surfels', 'MB', 'distance p50 m', 'p95', 'work p50 ms', 'p95'],
      [
        [
          result.remembered,
          result.ghosts,
          surfels,
          result.megabytes,
          result.distanceM.p50,
          result.distanceM.p95,
          result.workMs.p50,
          result.workMs.p95,
        ],
      ],
    );
    if (json) printJson({ bench: 'memory', seconds, seed, ...result });
  },
};

function share(value: number): number {
  return Math.round(value * 10_000) / 10_000;
}
