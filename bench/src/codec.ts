/**
 * `pnpm bench codec`: size and quality of clouds from the point codecs, the codecs' speed, and the effect of packet
 * loss.
 */
import { writeFile } from 'node:fs/promises';
import { parseArgs } from 'node:util';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import type { BenchCloud, CodecRun } from './codec/adapter.ts';
import { pcdCloud, rgbdClouds, simulatedClouds } from './codec/clouds.ts';
import { draco, loadDraco } from './codec/draco.ts';
import { type CodecRow, measureCodec } from './codec/measure.ts';
import { loadMeshopt, meshopt } from './codec/meshopt.ts';
import { ORGANISED_SETTINGS, organised } from './codec/organised.ts';
import { plotCodecs } from './codec/plot.ts';
import { points64, zstd } from './codec/points64.ts';
import { unorganised, unorganisedSteps } from './codec/unorganised.ts';
import { type Bench, numberOption, printJson, printTable } from './report.ts';

const USAGE = `pnpm bench codec [--cloud FILE.pcd]… [--rgbd DIR] [--codec NAME]… [--rounds 15] [--native] [--plot FILE.svg] [--json]

Kernel benchmark, in one process. Encodes and decodes each cloud (default: frames of the simulated camera) with every
codec, compares the output with the input point by point, and drops 1, 5 and 20 % of the packets.

Times are medians in WASM (zstd: native); with --native also of the native Rust code, if Cargo is installed.
depthErrorMmPerZ2 is the worst error of depth (range, for a cloud without a grid) over its square. pointsLost and
pointsWrong are shares, 0-1; a codec whose output is one blob loses the frame with any of its packets of 1200 bytes.
If a codec reorders points, each is compared with the nearest one, and colours are not compared. The output of \`organised\` is
compared as depth, before points are rounded to millimetres.`;

export const bench: Bench = {
  name: 'codec',
  summary:
    'kernel: bits, errors, time and packet loss of the point codecs, beside Draco, meshoptimizer and Zstandard',
  async run(argv) {
    const { values, positionals } = parseArgs({
      args: argv,
      options: {
        cloud: { type: 'string', multiple: true, default: [] },
        rgbd: { type: 'string' },
        codec: { type: 'string', multiple: true, default: [] },
        rounds: { type: 'string', default: '15' },
        native: { type: 'boolean', default: false },
        plot: { type: 'string' },
        json: { type: 'boolean' },
        help: { type: 'boolean' },
      },
      allowPositionals: true,
    });
    if (values.help) return console.log(USAGE);
    const rounds = numberOption('rounds', values.rounds, 1);
    // Accepts `--cloud a.pcd b.pcd` as well as `--cloud a.pcd --cloud b.pcd`.
    const clouds: BenchCloud[] = [
      ...[...values.cloud, ...positionals].map(pcdCloud),
      ...(values.rgbd === undefined ? [] : rgbdClouds(values.rgbd)),
    ];
    if (clouds.length === 0) clouds.push(...(await simulatedClouds()));

    const makers = await codecMakers();
    const wanted = Object.entries(makers).filter(
      ([name]) => values.codec.length === 0 || values.codec.includes(name),
    );
    if (wanted.length === 0) throw new Error(`--codec: there are ${Object.keys(makers).join(', ')}`);
    const rows: CodecRow[] = [];
    const notes = new Set<string>();
    for (const cloud of clouds) {
      for (const [name, runsOf] of wanted) {
        for (const make of runsOf(cloud)) {
          const made = make();
          if (typeof made === 'string') {
            notes.add(`${cloud.name}: ${name} left out: ${made}`);
            continue;
          }
          using run = made;
          rows.push(measureCodec(cloud, run, rounds, values.native));
        }
      }
    }

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
    for (const note of notes) console.log(note);
    if (values.plot !== undefined) {
      await writeFile(values.plot, plotCodecs(rows));
      console.log(`plot: ${values.plot}`);
    }
    if (values.json) printJson({ bench: 'codec', rounds, rows, leftOut: [...notes] });
  },
};

/**
 * For every codec, the settings that make sense for a cloud, or why there are none. Runs are created one at a time,
 * because they take memory.
 */
async function codecMakers(): Promise<Record<string, (cloud: BenchCloud) => (() => CodecRun | string)[]>> {
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
