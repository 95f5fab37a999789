/** `pnpm bench mtp`: motion-to-photon latency of the whole stack on this machine, without a network in between. */
import { POINTS_PER_PACKET } from '@farpoint/protocol';
import { benchOptions, type OptionValues, option } from './bench-options.ts';
import { startLiveStack } from './live-stack.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import { distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench mtp [--points 30000] [--fps 30] [--samples 100] [--mbps 300] [--canvas 160x90] [--json]

Real signaling, robot (simulated office) and headless Chromium. Each sample is one latency test: from an input event to the
end of the display frame that shows the whole green cloud (mtpMs) or its first points (mtpFirstMs). Input events are not
synchronised with the camera. --mbps limits what the robot sends; the camera has 480 × 480 points.`;

const OPTIONS = {
  points: option.number(30_000, { least: POINTS_PER_PACKET }),
  fps: option.number(30, { least: 1 }),
  samples: option.number(100, { least: 1 }),
  mbps: option.number(300, { least: 1 }),
  canvas: option.text('160x90'),
};
type Options = OptionValues<typeof OPTIONS>;

export const bench: Bench = {
  name: 'mtp',
  summary: 'motion-to-photon of the whole stack on this machine',
  usage: USAGE,
  async run(argv) {
    const options = benchOptions(argv, OPTIONS);
    const live = await startLiveStack({
      robot: { id: 'sim-1', name: 'Simulated robot', args: robotArgs(options) },
      canvas: options.canvas,
      log: (line) => console.error(line),
    });
    try {
      const { page } = live;
      await page.evaluate(() => window.farpoint.latencyTest());
      await page.evaluate(() => window.farpoint.resetStats());
      console.error(`${options.samples} latency tests`);
      const results = await page.evaluate(testLatency, options.samples);
      const stats = await page.evaluate(() => window.farpoint.stats());
      report(options, results, stats);
    } finally {
      await live.close();
    }
  },
};

function robotArgs({ points, fps, mbps }: Options): string[] {
  return [
    '--mode',
    'points64',
    '--fps',
    String(fps),
    '--max-points',
    String(points),
    '--rate-control',
    'fixed',
    '--plan',
    'paper',
    '--bitrate-mbps',
    String(mbps),
  ];
}

/**
 * Runs in the page, where nothing outside its braces exists. The pauses follow a fixed sequence (the golden ratio's), so that events are spread evenly over the
 * camera's period.
 */
async function testLatency(count: number) {
  const results = [];
  for (let i = 0; i < count; i++) {
    await new Promise((resolve) => setTimeout(resolve, 60 + ((i * 0.618034) % 1) * 80));
    results.push(await window.farpoint.latencyTest());
  }
  return results;
}

function report(
  { canvas, json }: Options,
  results: Awaited<ReturnType<typeof testLatency>>,
  stats: ReturnType<Window['farpoint']['stats']>,
): void {
  const mtpMs = rounded(distribution(results.map((result) => result.mtpMs)), 1);
  const mtpFirstMs = rounded(distribution(results.map((result) => result.firstMs)), 1);
  printTable(
    ['', 'p50', 'p95', 'p99', 'max'],
    [
      ['motion to whole cloud, ms', ...distributionCells(mtpMs)],
      ['motion to first points, ms', ...distributionCells(mtpFirstMs)],
      ['frame latency, ms', ...(stats.frameLatencyMs ? distributionCells(stats.frameLatencyMs) : [])],
      ['render, ms', ...(stats.renderMs ? distributionCells(stats.renderMs) : [])],
    ],
  );
  console.log(
    `${results.length} samples, ${stats.framesPerSecond.toFixed(1)} frames/s of ${Math.round(stats.pointsPerFrame)} points, ` +
      `canvas ${canvas}, ${stats.displayFramesPerSecond.toFixed(0)} display frames/s`,
  );
  if (!json) return;
  printJson({
    bench: 'mtp',
    mtpMs,
    mtpFirstMs,
    samples: results.length,
    framesPerSecond: stats.framesPerSecond,
    pointsPerFrame: stats.pointsPerFrame,
    frameLatencyMs: stats.frameLatencyMs,
    renderMs: stats.renderMs,
    displayFramesPerSecond: stats.displayFramesPerSecond,
    lossRate: stats.lossRate,
    canvas,
  });
}
