/**
 * `pnpm bench codec`: size and quality of clouds from the point codecs, the codecs' speed, and the effect of packet
 * loss.
 */
import { writeFile } from 'node:fs/promises';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { benchOptions, type OptionValues, option } from './bench-options.ts';
import type { BenchCloud, CodecRun } from './codec/adapter.ts';
import { pcdCloud, rgbdClouds, simulatedClouds } from './codec/clouds.ts';
import { draco, loadDraco } from './codec/draco.ts';
import { type CodecRow, measureCodec } from './codec/measure.ts';
import { loadMeshopt, meshopt } from './codec/meshopt.ts';
import { ORGANISED_SETTINGS, organised } from './codec/organised.ts';
import { plotCodecs } from './codec/plot.ts';
import { points64, zstd } from './codec/points64.ts';
import { unorganised, unorganisedSteps } from './codec/unorganised.ts';
import { type Bench, printJson, printTable } from './report.ts';

const USAGE = `pnpm bench codec [--cloud FILE.pcd]… [--rgbd DIR] [--codec NAME]… [--rounds 15] [--native] [--plot FILE.svg] [--json]

Kernel benchmark, in one process. Encodes and decodes each cloud (default: frames of the simulated camera) with every
codec, compares the output with the input point by point, and drops 1, 5 and 20 % of the packets.

Times are medians in WASM (zstd: native); with --native also of the native Rust code, if Cargo is installed.
depthErrorMmPerZ2 is the worst error of depth (range, for a cloud without a grid) over its square. pointsLost and
pointsWrong are shares, 0-1; a codec whose output is one blob loses the frame with any of its packets of 1200 bytes.
If a codec reorders points, each is compared with the nearest one, and colours are not compared. The output of \`organised\` is
compared as depth, before points are rounded to millimetres.`;

const OPTIONS = {
  /** PCD files: `--cloud a.pcd b.pcd` is accepted as well as `--cloud a.pcd --cloud b.pcd`. */
  cloud: option.repeated,
  others: option.bare,
  /** Folder of pictures with depth. */
  rgbd: option.text(),
  /** Names of codecs; empty: all. */
  codec: option.repeated,
  rounds: option.number(15, { least: 1 }),
  native: option.flag,
  plot: option.text(),
};
type Options = OptionValues<typeof OPTIONS>;

export const bench: Bench = {
  name: 'codec',
  summary:
    'kernel: bits, errors, time and packet loss of the point codecs, beside Draco, meshoptimizer and Zstandard',
  usage: USAGE,
  async run(argv) {
    const options = benchOptions(argv, OPTIONS);
    const clouds = await readClouds(options);
    const makers = await codecMakers();
    const wanted = Object.entries(makers).filter(
      ([name]) => options.codec.length === 0 || options.codec.includes(name),
    );
    if (wanted.length === 0) throw new Error(`--codec: there are ${Object.keys(makers).join(', ')}`);
    const { rows, notes } = measureAll(clouds, wanted, options);
    print(rows);
    for (const note of notes) console.log(note);
    if (options.plot !== undefined) {
      await writeFile(options.plot, plotCodecs(rows));
      console.log(`plot: ${options.plot}`);
    }
    if (options.json) printJson({ bench: 'codec', rounds: options.rounds, rows, leftOut: [...notes] });
  },
};

/** Takes clouds of the simulated camera if no others are given. */
async function readClouds({ cloud, others, rgbd }: Options): Promise<BenchCloud[]> {
  const clouds = [...[...cloud, ...others].map(pcdCloud), ...(rgbd === undefined ? [] : rgbdClouds(rgbd))];
  return clouds.length === 0 ? await simulatedClouds() : clouds;
}

/** @returns the rows, and notes that say why a codec was left out */
function measureAll(
  clouds: readonly BenchCloud[],
  makers: readonly [name: string, runsOf: RunMakers][],
  { rounds, native }: Options,
): { rows: CodecRow[]; notes: Set<string> } {
  const rows: CodecRow[] = [];
  const notes = new Set<string>();
  for (const cloud of clouds) {
    for (const [name, runsOf] of makers) {
      for (const make of runsOf(cloud)) {
        const made = make();
        if (typeof made === 'string') {
          notes.add(`${cloud.name}: ${name} left out: ${made}`);
          continue;
        }
        using run = made;
        rows.push(measureCodec(cloud, run, rounds, native));
      }
    }
  }
  return { rows, notes };
}

function print(rows: readonly CodecRow[]): void {
  printTable(
    [
      'cloud',
      'codec',
      'setting',
      'points',
      'bits/pt',
      'mm/z²',
      'mm',
      'PSNR',
      'enc ms',
      'dec ms',
      'lost at 5 %',
      'wrong',
    ],
    rows.map((row) => [
      row.cloud,
      row.codec,
      row.setting,
      row.sentPoints,
      row.bitsPerPoint,
      row.depthErrorMmPerZ2,
      row.depthErrorMm,
      row.colorPsnrDb,
      row.encodeMs,
      row.decodeMs,
      `${(row.loss['5'].pointsLost * 100).toFixed(1)} %`,
      row.loss['5'].pointsWrong,
    ]),
  );
}

/** Each function that it returns makes a run for the cloud, or says why there is none. */
type RunMakers = (cloud: BenchCloud) => (() => CodecRun | string)[];

/**
 * For every codec, the settings that make sense for a cloud, or why there are none. Runs are created one at a time,
 * because they take memory.
 */
async function codecMakers(): Promise<Record<string, RunMakers>> {
  const codec = await loadCodecFromDisk();
  const dracoModules = await loadDraco();
  await loadMeshopt();
  // Chosen to fit int16: millimetres for a camera, centimetres for a LiDAR.
  const coarse = (cloud: BenchCloud) => (cloud.depth === 'range' ? 10 : 1);
  return {
    points64: (cloud) => [() => points64(codec, cloud)],
    organised: (cloud) => ORGANISED_SETTINGS.map((setting) => () => organised(codec, cloud, setting)),
    unorganised: (cloud) => unorganisedSteps(cloud).map((step) => () => unorganised(codec, cloud, step)),
    draco: (cloud) => [
      () => draco(dracoModules, cloud, coarse(cloud), 10),
      () => draco(dracoModules, cloud, coarse(cloud), 5),
    ],
    meshopt: (cloud) => [() => meshopt(cloud, coarse(cloud))],
    zstd: (cloud) => [() => zstd(codec, cloud)],
  };
}
