/** `pnpm bench beside`: another checkout and this one in turns, on the same machine, as medians. */
import { spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { repositoryRoot } from '@farpoint/local-stack';
import { benchOptions, option } from './bench-options.ts';
import { type Bench, printJson, printTable } from './report.ts';
import { quantile } from './stats.ts';

const USAGE = `pnpm bench beside FOLDER [--runs 5] [--keys mtpMs.p50,mtpMs.p95,framesPerSecond] [--json] -- NAME [options]

Runs a benchmark in another checkout of this repository, installed, and in this one, in turns: what the machine does besides
meets both alike. Prints the medians of the figures with these names in the benchmark's JSON, and this checkout's as a ratio to
the other's.

  pnpm bench beside ../farpoint-before -- link --mode auto --seconds 20`;

export const bench: Bench = {
  name: 'beside',
  summary: 'another checkout and this one in turns: medians side by side',
  usage: USAGE,
  async run(argv) {
    const split = argv.indexOf('--');
    const { folders, runs, keys, json } = benchOptions(split < 0 ? argv : argv.slice(0, split), {
      folders: option.bare,
      runs: option.number(5, { least: 1 }),
      keys: option.list(['mtpMs.p50', 'mtpMs.p95', 'framesPerSecond'], option.text()),
    });
    const command = split < 0 ? [] : argv.slice(split + 1);
    const [given] = folders;
    if (given === undefined || folders.length > 1 || command.length === 0) throw new Error(USAGE);
    const other = resolve(given);
    if (!existsSync(join(other, 'bench', 'main.ts')))
      throw new Error(`${other} is no checkout of this repository: it has no bench/main.ts`);

    const series = { other: keys.map((): number[] => []), here: keys.map((): number[] => []) };
    for (let run = 1; run <= runs; run++) {
      for (const [side, folder] of [
        ['other', other],
        ['here', repositoryRoot],
      ] as const) {
        console.error(`${run} of ${runs}: ${folder}`);
        const result = runIn(folder, command);
        for (const [i, key] of keys.entries()) series[side][i]?.push(figureAt(result, key));
      }
    }
    const rows = keys.map((name, i) => {
      const [otherMedian, hereMedian] = [median(series.other[i] ?? []), median(series.here[i] ?? [])];
      return { name, other: otherMedian, here: hereMedian, ratio: hereMedian / otherMedian };
    });
    printTable(
      ['', 'other', 'here', 'ratio'],
      rows.map((row) => [row.name, row.other, row.here, row.ratio]),
    );
    if (json) printJson({ bench: 'beside', command, runs, rows, series });
  },
};

/** @returns what the benchmark printed as JSON @throws {Error} with its output if it failed */
function runIn(folder: string, [name = '', ...options]: readonly string[]): unknown {
  const { status, stdout, stderr } = spawnSync(
    process.execPath,
    [join(folder, 'bench', 'main.ts'), name, ...options, '--json'],
    { cwd: folder, encoding: 'utf8' },
  );
  const last = stdout.trim().split('\n').at(-1) ?? '';
  if (status !== 0 || !last.startsWith('{')) throw new Error(`in ${folder}:\n${stdout}${stderr}`);
  return JSON.parse(last);
}

/** The number at a path such as `mtpMs.p50`. @throws {Error} if there is none */
export function figureAt(result: unknown, path: string): number {
  let at = result;
  for (const key of path.split('.'))
    at = typeof at === 'object' && at !== null ? (at as Record<string, unknown>)[key] : undefined;
  if (typeof at !== 'number') throw new Error(`the benchmark’s JSON has no number \`${path}\``);
  return at;
}

function median(values: readonly number[]): number {
  return quantile(Float64Array.from(values).sort(), 0.5);
}
