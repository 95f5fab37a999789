/** `pnpm bench sampling`: how many points survive sampling at each distance (the paper's figures 4 and 5). */

import { writeFile } from 'node:fs/promises';
import { basename } from 'node:path';
import { BitRate } from '@farpoint/timing';
import { type Codec, maxPoints, Points64Encoder } from '@farpoint/wasm-codec';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { benchOptions, option } from './bench-options.ts';
import { type Panel, renderChart, type Series } from './plot/chart.ts';
import { type Bench, printJson, printTable } from './report.ts';
import { pcdCloud, simulatedCloud } from './sampling-clouds.ts';
import type { SceneCloud } from './sampling-scene.ts';

const USAGE = `pnpm bench sampling [--cloud FILE.pcd] [--fps 10] [--near 3.85] [--plot FILE.svg] [--json]

Samples one cloud (from the simulated camera or a PCD file) at several bandwidths and values of lambda, and counts the
points kept at each distance: once with equal weights for all points nearer than --near metres (the paper's D), and once
without such a zone. Without --plot it prints only the mean depth.`;

const LAMBDAS = [0, 3, 7, 9];
const MEGABITS = [10, 25, 50];
const BINS = 48;

interface Histogram {
  /** Number of points in each depth bin. */
  counts: number[];
  meanDepth: number;
}

interface Curve extends Histogram {
  nearDistance: number;
  lambda: number;
  mbps: number;
  kept: number;
}

interface Sampled {
  /** Points of the cloud. */
  points: number;
  /** Points that can be sent, and the depth of the farthest, m. */
  valid: number;
  maxDepth: number;
  /** Width of a depth bin, m. */
  binM: number;
  whole: Histogram;
  curves: Curve[];
}

export const bench: Bench = {
  name: 'sampling',
  summary: 'kept points over distance for several bandwidths and lambdas, as a plot',
  usage: USAGE,
  async run(argv) {
    const {
      cloud: file,
      fps: framesPerSecond,
      near,
      plot: plotFile,
      json,
    } = benchOptions(argv, {
      cloud: option.text(),
      fps: option.number(10, { least: 0.1 }),
      near: option.number(3.85),
      plot: option.text(),
    });
    const nearDistances = [...new Set([near, 0])];
    const cloud = file === undefined ? await simulatedCloud() : await pcdCloud(file);
    const sampled = sampleAll(await loadCodecFromDisk(), cloud, nearDistances, framesPerSecond);
    const name = file === undefined ? 'simulated office' : basename(file);
    print(name, sampled);
    if (plotFile !== undefined) {
      await writeFile(plotFile, plot(name, framesPerSecond, sampled));
      console.log(`plot: ${plotFile}`);
    }
    if (json) {
      const { points, valid, binM, whole, curves } = sampled;
      printJson({ bench: 'sampling', cloud: name, points, valid, binM, raw: whole.counts, curves });
    }
  },
};

/** Samples the cloud at each bandwidth with each lambda. */
function sampleAll(
  codec: Codec,
  { frame, points }: SceneCloud,
  nearDistances: readonly number[],
  framesPerSecond: number,
): Sampled {
  using encoder = new Points64Encoder(codec, points);
  encoder.frameBits.set(new Uint32Array(frame.buffer, 0, points * 4));
  const raw = encoder.sample({ points, count: points, seed: 0 });
  const binM = raw.maxDepth / BINS;
  const whole = histogram(frame, encoder.chosen, binM);
  const curves: Curve[] = [];
  for (const nearDistance of nearDistances) {
    for (const mbps of MEGABITS) {
      const count = maxPoints({ bitsPerSecond: BitRate.fromMbps(mbps), framesPerSecond, points });
      for (const lambda of LAMBDAS) {
        const { kept } = encoder.sample({ points, count, lambda, nearDistance, seed: 1 });
        curves.push({ nearDistance, lambda, mbps, kept, ...histogram(frame, encoder.chosen, binM) });
      }
    }
  }
  return { points, valid: raw.kept, maxDepth: raw.maxDepth, binM, whole, curves };
}

/** @param chosen indices of points in the frame */
function histogram(frame: Float32Array, chosen: Uint32Array, binM: number): Histogram {
  const counts = new Array<number>(BINS).fill(0);
  let sum = 0;
  for (const index of chosen) {
    const z = frame[index * 4 + 2] as number;
    const bin = Math.min(BINS - 1, Math.floor(z / binM));
    counts[bin] = (counts[bin] as number) + 1;
    sum += z;
  }
  return { counts, meanDepth: sum / chosen.length };
}

function print(name: string, { points, valid, maxDepth, whole, curves }: Sampled): void {
  console.log(`${name}: ${points} points, ${valid} of them valid, up to ${maxDepth.toFixed(1)} m`);
  printTable(
    ['D m', 'Mbit/s', 'lambda', 'kept', 'mean depth m'],
    [
      ['', 'raw', '', valid, whole.meanDepth],
      ...curves.map((curve) => [
        `${curve.nearDistance}`,
        `${curve.mbps}`,
        `${curve.lambda}`,
        curve.kept,
        curve.meanDepth,
      ]),
    ],
  );
}

function plot(name: string, framesPerSecond: number, { points, binM, whole, curves }: Sampled): string {
  const edges = Array.from({ length: BINS + 1 }, (_, i) => i * binM);
  // A step holds until the next edge, so the last value is repeated at the end.
  const steps = (counts: readonly number[]) => [...counts, counts.at(-1) ?? 0];
  const axes = { xLabel: 'depth (m)', yLabel: `points per ${(edges[1] as number).toFixed(2)} m` };
  const cloud: Series = { label: 'raw cloud', x: edges, y: steps(whole.counts), shape: 'area' };
  const seriesOf = (curve: Curve, label: string): Series => ({
    label,
    x: edges,
    y: steps(curve.counts),
    shape: 'step',
  });
  const nearDistances = [...new Set(curves.map((curve) => curve.nearDistance))];
  const panels = nearDistances.flatMap((nearDistance) =>
    MEGABITS.map((mbps): Panel => {
      const of = curves.filter((curve) => curve.nearDistance === nearDistance && curve.mbps === mbps);
      const kept = of[0]?.kept.toLocaleString('en-US');
      return {
        ...axes,
        title: `D = ${nearDistance} m, ${mbps} Mbit/s: ${kept} points`,
        series: [cloud, ...of.map((curve) => seriesOf(curve, `λ = ${curve.lambda}`))],
      };
    }),
  );
  return renderChart({
    title: 'Points kept by the depth-weighted sampling',
    subtitle: `${name}, ${points.toLocaleString('en-US')} points, ${framesPerSecond} frames/s, ε = 1e-6; points nearer than D weigh as much as the nearest`,
    panels,
    columns: MEGABITS.length,
  });
}
