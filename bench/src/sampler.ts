/** `pnpm bench sampler`: a kernel benchmark of the depth-weighted sampling. */
import { spawnSync } from 'node:child_process';
import { join } from 'node:path';
import { type Codec, Points64Encoder } from '@farpoint/wasm-codec';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { benchOptions, type OptionValues, option } from './bench-options.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import { depthWeights, SamplingFit } from './sampling-fit.ts';
import { hallCloud, type SceneCloud, validDepths } from './sampling-scene.ts';
import { type Distribution, distribution, rounded, timeCalls } from './stats.ts';

const USAGE = `pnpm bench sampler [--points 230400] [--n 30000] [--lambda 3] [--rounds 300] [--draws 40] [--json]

Kernel benchmark, in one process. Chooses --n of --points points by the paper's depth weights, in WASM and, if Cargo is
installed, natively; compares --draws draws with the exact distribution (p-value of a chi-square test).`;

interface Figures {
  wasm: Distribution;
  native: Distribution | null;
  /** `null` if there was nothing to choose. */
  pValue: number | null;
}

const OPTIONS = {
  points: option.number(230_400, { least: 1 }),
  /** Points that are chosen. */
  n: option.number(30_000, { least: 1 }),
  lambda: option.number(3),
  rounds: option.number(300, { least: 1 }),
  draws: option.number(40, { least: 1 }),
};
type Options = OptionValues<typeof OPTIONS>;

export const bench: Bench = {
  name: 'sampler',
  summary: 'kernel: time of the depth-weighted sampling, and a test of its distribution',
  usage: USAGE,
  async run(argv) {
    const options = benchOptions(argv, OPTIONS);
    report(options, measure(await loadCodecFromDisk(), options));
  },
};

function measure(codec: Codec, options: Options): Figures {
  const { points, n: count, lambda, rounds } = options;
  using encoder = new Points64Encoder(codec, points);
  const cloud = hallCloud(points);
  encoder.frameBits.set(new Uint32Array(cloud.frame.buffer));
  const sample = (seed: number) => encoder.sample({ points, count, lambda, seed });
  return {
    wasm: rounded(distribution(timeCalls(sample, rounds)), 4),
    native: nativeTimes(points, count, rounds),
    pValue: testDistribution(cloud, options, (seed) => {
      sample(seed);
      return encoder.chosen;
    }),
  };
}

/** @param draw chooses indices of points @returns the p-value; `null` if all points are kept */
function testDistribution(
  cloud: SceneCloud,
  { points, n: count, lambda, draws }: Options,
  draw: (seed: number) => Uint32Array,
): number | null {
  const { depths, indices } = validDepths(cloud);
  if (count >= depths.length) return null;
  const parameters = { lambda, epsilon: 1e-6, nearDistance: 3.85 };
  const positions = new Int32Array(points).fill(-1);
  indices.forEach((index, position) => {
    positions[index] = position;
  });
  const fit = new SamplingFit(depths, depthWeights(depths, parameters), count);
  for (let seed = 0; seed < draws; seed++) fit.add(draw(seed).map((index) => positions[index] as number));
  return fit.pValue();
}

function report({ points, n: count, lambda, draws, json }: Options, { wasm, native, pValue }: Figures): void {
  console.log(`${count} of ${points} points, lambda ${lambda} (kernel: one process, no link)`);
  const rows: (string | number)[][] = [['WASM', ...distributionCells(wasm)]];
  if (native !== null) rows.push(['native', ...distributionCells(native)]);
  printTable(['ms', 'p50', 'p95', 'p99', 'max'], rows);
  if (native === null) console.log('native: not measured, Cargo is not there');
  if (pValue === null) console.log('distribution: all points were kept, there was no draw');
  else console.log(`distribution: p = ${pValue.toPrecision(3)} over ${draws} draws`);
  if (!json) return;
  printJson({
    bench: 'sampler',
    points,
    n: count,
    lambda,
    msP50: wasm.p50,
    nativeMsP50: native?.p50 ?? null,
    pValue,
    wasmMs: wasm,
    nativeMs: native,
  });
}

/** Times the same sampler compiled for this machine's processor; null if that is impossible. */
function nativeTimes(points: number, count: number, rounds: number): Distribution | null {
  const workspace = join(import.meta.dirname, '../../wasm-codec');
  const result = spawnSync(
    'cargo',
    ['bench', '-q', '--locked', '-p', 'farpoint-point-codec', '--bench', 'sampler', '--'].concat([
      '--points',
      `${points}`,
      '--n',
      `${count}`,
      '--rounds',
      `${rounds}`,
    ]),
    {
      cwd: workspace,
      encoding: 'utf8',
      stdio: ['ignore', 'pipe', 'ignore'],
      env: {
        ...process.env,
        RUSTFLAGS: '-Ctarget-cpu=native',
        CARGO_TARGET_DIR: join(workspace, 'target', 'native'),
      },
    },
  );
  if (result.status !== 0) return null;
  const line = result.stdout.trim().split('\n').at(-1) ?? '';
  try {
    const value: unknown = JSON.parse(line);
    if (typeof value !== 'object' || value === null) return null;
    const { p50, p95, p99, max } = value as Record<string, unknown>;
    if (typeof p50 !== 'number' || typeof p95 !== 'number') return null;
    if (typeof p99 !== 'number' || typeof max !== 'number') return null;
    return { p50, p95, p99, max };
  } catch {
    return null;
  }
}
