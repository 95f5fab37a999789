/** `pnpm bench shm`: clouds through shared memory, from a producer's process to the robot's first packet. */
import { processFolder } from '@farpoint/local-stack';
import { type KillTestResult, runKillTest } from '@farpoint/shared-memory/kill-test';
import { benchOptions, type OptionValues, option } from './bench-options.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import { buildSharedMemory, LAYOUTS, type Layout, type LayoutResult, measure } from './shm-run.ts';

const USAGE = `pnpm bench shm [--layout both|reference|farpoint] [--size 480] [--fps 30] [--seconds 20] [--mbps 20] [--kill N [--seed 1]] [--json]

A producer process writes size × size points --fps times a second; the real robot process samples them for --mbps (10^6
bit/s) and sends them to an operator in this process. Latency: from when the producer starts to write a frame until the robot
has the frame's packets ready. Every frame has its own colour: torn counts frames that arrived with two colours.
--kill N instead kills the producer and reader processes at random until N frames have been read and checked in full.`;

const OPTIONS = {
  layout: option.choice('both', ['both', ...LAYOUTS]),
  size: option.number(480, { least: 16 }),
  fps: option.number(30, { least: 1 }),
  seconds: option.number(20, { least: 1 }),
  mbps: option.number(20, { least: 1 }),
  /** Number of frames to read and check. */
  kill: option.number(undefined, { least: 1 }),
  seed: option.number(1),
};
type Options = OptionValues<typeof OPTIONS>;

export const bench: Bench = {
  name: 'shm',
  summary: 'clouds through shared memory: latency to the first packet, torn frames, kills',
  usage: USAGE,
  async run(argv) {
    const options = benchOptions(argv, OPTIONS);
    const layouts = LAYOUTS.filter((layout) => options.layout === 'both' || options.layout === layout);
    if (options.size > 480 && layouts.includes('reference'))
      throw new Error('--size: the reference layout ends at 480');
    buildSharedMemory();
    if (options.kill === undefined) await measureLayouts(layouts, options);
    else await killSides(layouts, options.kill, options);
  },
};

async function measureLayouts(
  layouts: readonly Layout[],
  { size, fps, seconds, mbps, json }: Options,
): Promise<void> {
  const results: Partial<Record<Layout, LayoutResult>> = {};
  for (const layout of layouts) {
    console.error(`${layout}: ${size * size} points at ${fps} frames/s for ${seconds} s`);
    results[layout] = await measure(layout, { size, fps, seconds, mbps });
  }
  printLayouts(results);
  if (!json) return;
  const all = Object.values(results);
  const worst = all.reduce((a, b) => (b.latencyMs.p99 > a.latencyMs.p99 ? b : a));
  printJson({
    bench: 'shm',
    points: size * size,
    fps,
    seconds,
    mbps,
    // Of the layouts measured, the worst.
    latencyMs: worst.latencyMs,
    framesPerSecond: Math.min(...all.map((result) => result.framesPerSecond)),
    torn: all.reduce((sum, result) => sum + result.torn, 0),
    rssMbMax: Math.max(...all.map((result) => result.rssMbMax)),
    layouts: results,
  });
}

function printLayouts(results: Partial<Record<Layout, LayoutResult>>): void {
  const rows = Object.entries(results);
  printTable(
    ['latency, ms', 'p50', 'p95', 'p99', 'max'],
    rows.map(([layout, { latencyMs }]) => [layout, ...distributionCells(latencyMs)]),
  );
  printTable(
    ['', 'frames/s', 'torn', 'robot, MB', 'robot, cores', 'producer, cores', 'points sent'],
    rows.map(([layout, result]) => [
      layout,
      result.framesPerSecond,
      result.torn,
      result.rssMbMax,
      result.robotCpu,
      result.producerCpu,
      result.pointsPerFrame,
    ]),
  );
}

async function killSides(
  layouts: readonly Layout[],
  kill: number,
  { size, seed, json }: Options,
): Promise<void> {
  const results = await killAll(layouts, kill, size * size, seed);
  if (json) printJson({ bench: 'shm', points: size * size, ...summedKills(results), kill: results });
}

async function killAll(
  layouts: readonly Layout[],
  frames: number,
  points: number,
  seed: number,
): Promise<Partial<Record<Layout, KillTestResult>>> {
  const results: Partial<Record<Layout, KillTestResult>> = {};
  for (const layout of layouts) {
    const folder = processFolder('/dev/shm');
    console.error(`${layout}: ${frames} frames of ${points} points, both sides killed at random`);
    results[layout] = await runKillTest({
      layout,
      folder,
      frames,
      points,
      leastKills: 10,
      seed,
      lifeMs: [20, 1500],
    });
  }
  printTable(
    ['', 'frames', 'torn', 'producer kills', 'reader kills', 'longest pause, ms', 'frames/s'],
    Object.entries(results).map(([layout, result]) => [
      layout,
      result.frames,
      result.torn,
      result.producerKills,
      result.readerKills,
      result.longestPauseMs,
      result.frames / result.seconds,
    ]),
  );
  return results;
}

function summedKills(results: Partial<Record<Layout, KillTestResult>>): { frames: number; torn: number } {
  const all = Object.values(results);
  const sum = (of: (result: KillTestResult) => number) => all.reduce((total, each) => total + of(each), 0);
  return { frames: sum(({ frames }) => frames), torn: sum(({ torn }) => torn) };
}
