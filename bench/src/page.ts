/** `pnpm bench page`: what the operator's page costs its own main thread and memory, for as long as one likes. */
import type {} from '@farpoint/webxr/test-api';
import type { Page } from '@playwright/test';
import { benchOptions, type OptionValues, option } from './bench-options.ts';
import { type CpuBudget, calibrationMs, compareWithBudget } from './cpu-budgets.ts';
import { type LiveStack, startLiveStack } from './live-stack.ts';
import { type CpuProfile, mainThreadTime } from './page-profile.ts';
import { memoryMbOf } from './process-memory.ts';
import { type Bench, printJson, printTable } from './report.ts';

const USAGE = `pnpm bench page [--seconds 60] [--fps 58] [--mbps 41.44] [--draw-every 8] [--surface] [--memory]
  [--canvas 160x90] [--json]

Real signaling, robot (simulated office, 480 × 480 points, driven in circles) and headless Chromium. mainThreadMs is script
time on the page's main thread for each cloud frame drawn, by a CPU profile; waiting for the software renderer is counted
apart. Memory is the proportional set size of the page's process, read every second. firstPictureMs is from choosing a robot
to its first points drawn. --draw-every draws 1 of so many points, because the renderer is software here; all are received,
decoded and uploaded. --surface and --memory show surfaces and the remembered world.

With the defaults, budgets for this computer's speed stand beside the figures, and what is more than a quarter over is named.`;

/** The page must have found its pace. */
const WARM_UP_MS = 5000;
const PROFILE_MS = 10_000;
const SAMPLE_EVERY_US = 500;

/** The load that the budgets are for. */
const LOAD = {
  fps: option.number(58, { least: 1 }),
  mbps: option.number(41.44, { least: 0.1 }),
  /** Draws 1 of so many points. */
  drawEvery: option.number(8, { least: 1 }),
  canvas: option.text('160x90'),
  surface: option.flag,
  memory: option.flag,
};
/** Milliseconds a frame on the main thread, on the budgets' computer. */
const BUDGET: CpuBudget = { script: 3.1, browser: 2.6, total: 5.7 };

/** The page's memory at one time. */
interface Memory {
  atS: number;
  pageMb: number;
  heapMb: number;
}

const OPTIONS = {
  seconds: option.number(60, { least: (WARM_UP_MS + PROFILE_MS) / 1000 }),
  ...LOAD,
};
type Options = OptionValues<typeof OPTIONS>;

export const bench: Bench = {
  name: 'page',
  summary: 'main thread, memory and first picture of the operator’s page',
  usage: USAGE,
  async run(argv) {
    const options = benchOptions(argv, OPTIONS);
    const { fps, mbps, drawEvery, canvas, surface, memory } = options;
    const speedMs = calibrationMs();
    const live = await startLiveStack({
      robot: {
        id: 'sim-1',
        name: 'Simulated robot',
        args: ['--fps', String(fps), '--rate-control', 'fixed', '--bitrate-mbps', String(mbps)],
      },
      canvas,
      query: `every=${drawEvery}`,
      stored: { 'farpoint.clouds': { surface, memory } },
      log: (line) => console.error(line),
    });
    try {
      const result = figuresOf(options, speedMs, await measure(live, options.seconds));
      print(result);
      if (options.json) printJson(result);
    } finally {
      await live.close();
    }
  },
};

interface Measured {
  firstPictureMs: number;
  profile: Profile;
  memory: Memory[];
}

/** Measures while the robot is driven. */
async function measure({ page, browserPid }: LiveStack, seconds: number): Promise<Measured> {
  const firstPictureMs = await timeFirstPicture(page);
  const driving = page.evaluate(driveInCircles, { ms: seconds * 1000, forward: 0.4 });
  const memory: Memory[] = [];
  const beganMs = performance.now();
  await page.waitForTimeout(WARM_UP_MS);
  const profile = await profileFor(page, PROFILE_MS);
  console.error(`memory, ${seconds} s`);
  for (;;) {
    const now = await memoryOf(page, browserPid, beganMs);
    if (now !== null) memory.push(now);
    const leftMs = seconds * 1000 - (performance.now() - beganMs);
    if (leftMs < 1000) break;
    await page.waitForTimeout(1000);
  }
  await driving;
  return { firstPictureMs, profile, memory };
}

/** @returns `null` without /proc */
async function memoryOf(page: Page, browserPid: number, beganMs: number): Promise<Memory | null> {
  const pageMb = memoryMbOf(browserPid, 'renderer');
  const heapMb = await page.evaluate(
    () => ((performance as never as { memory: { usedJSHeapSize: number } }).memory.usedJSHeapSize ?? 0) / 1e6,
  );
  if (pageMb === null) return null;
  return { atS: (performance.now() - beganMs) / 1000, pageMb, heapMb: Number(heapMb.toFixed(1)) };
}

type Figures = ReturnType<typeof figuresOf>;

/** @param speedMs this computer's calibration @returns the object that `--json` prints */
function figuresOf(options: Options, speedMs: number, { firstPictureMs, profile, memory }: Measured) {
  const isUsual = Object.entries(LOAD).every(([name, row]) => options[name as keyof Options] === row.default);
  const perFrame = (ms: number) => Number((ms / Math.max(profile.frames, 1)).toFixed(3));
  // Waiting costs nothing: it takes what the renderer leaves.
  const { scriptMs, browserMs, waitingMs, idleMs } = profile.time;
  const parts = new Map([
    ['script', perFrame(scriptMs)],
    ['browser', perFrame(browserMs)],
  ]);
  const half = memory.slice(memory.length >> 1);
  return {
    bench: 'page',
    seconds: options.seconds,
    surface: options.surface,
    memory: options.memory,
    drawnShare: Number((1 / options.drawEvery).toFixed(4)),
    calibrationMs: speedMs,
    budget: compareWithBudget(parts, isUsual ? BUDGET : {}, speedMs),
    framesPerSecond: Number(((profile.frames * 1000) / PROFILE_MS).toFixed(1)),
    pointsPerFrame: Math.round(profile.points / Math.max(profile.frames, 1)),
    mainThreadMs: perFrame(scriptMs),
    browserMs: perFrame(browserMs),
    waitingMs: perFrame(waitingMs),
    idleShare: Number((idleMs / PROFILE_MS).toFixed(3)),
    firstPictureMs: Math.round(firstPictureMs),
    rssMbFirst: memory[0]?.pageMb ?? null,
    rssMbMax: memory.length === 0 ? null : Math.max(...memory.map(({ pageMb }) => pageMb)),
    rssMbLast: memory.at(-1)?.pageMb ?? null,
    /** Of the second half, by least squares. */
    growthMbPerMinute: Number((60 * slopeOf(half.map(({ atS, pageMb }) => [atS, pageMb]))).toFixed(2)),
    heapMbMax: memory.length === 0 ? null : Math.max(...memory.map(({ heapMb }) => heapMb)),
  };
}

function print(result: Figures): void {
  const { budget } = result;
  printTable(
    ['main thread', 'ms a frame', 'budget'],
    budget.map(({ name, ms, budgetMs }) => [name, ms, budgetMs]),
  );
  const over = budget.filter((row) => row.over);
  if (over.length > 0) console.log(`over budget: ${over.map(({ name }) => name).join(', ')}`);
  console.log('');
  printTable(
    ['waiting, ms a frame', 'idle', 'frames/s', 'points a frame', 'first picture, ms'],
    [
      [
        result.waitingMs,
        result.idleShare,
        result.framesPerSecond,
        result.pointsPerFrame,
        result.firstPictureMs,
      ],
    ],
  );
  console.log('');
  printTable(
    ['memory of the page, MB: first', 'max', 'last', 'growth a minute, second half', 'heap, max'],
    [[result.rssMbFirst, result.rssMbMax, result.rssMbLast, result.growthMbPerMinute, result.heapMbMax]],
  );
}

/** Leaves the robot, and times it from choosing it again to its first points. */
function timeFirstPicture(page: Page): Promise<number> {
  return page.evaluate(async () => {
    const { farpoint } = window;
    const frame = () => new Promise((resolve) => requestAnimationFrame(resolve));
    farpoint.disconnect();
    while (farpoint.stats().framesDrawn > 0) await frame();
    const beganMs = performance.now();
    const connected = farpoint.connect('sim-1', 20_000);
    while (farpoint.stats().framesDrawn === 0) await frame();
    const tookMs = performance.now() - beganMs;
    await connected;
    return tookMs;
  });
}

type Profile = Awaited<ReturnType<typeof profileFor>>;

async function profileFor(page: Page, ms: number) {
  const counts = () =>
    page.evaluate(() => {
      const { framesDrawn, pointsDrawn } = window.farpoint.stats();
      return { framesDrawn, pointsDrawn };
    });
  const devTools = await page.context().newCDPSession(page);
  await devTools.send('Profiler.enable');
  await devTools.send('Profiler.setSamplingInterval', { interval: SAMPLE_EVERY_US });
  console.error(`CPU profile, ${ms / 1000} s`);
  await devTools.send('Profiler.start');
  const before = await counts();
  await page.waitForTimeout(ms);
  const after = await counts();
  const { profile } = await devTools.send('Profiler.stop');
  await devTools.detach();
  return {
    time: mainThreadTime(profile as CpuProfile),
    frames: after.framesDrawn - before.framesDrawn,
    points: after.pointsDrawn - before.pointsDrawn,
  };
}

/** Slope of the line of least squares; 0 of fewer than two points. */
function slopeOf(points: readonly (readonly [x: number, y: number])[]): number {
  if (points.length < 2) return 0;
  const mean = (at: 0 | 1) => points.reduce((sum, point) => sum + point[at], 0) / points.length;
  const [x, y] = [mean(0), mean(1)];
  const across = points.reduce((sum, point) => sum + (point[0] - x) * (point[1] - y), 0);
  return across / points.reduce((sum, point) => sum + (point[0] - x) ** 2, 0);
}

/** Drives the robot in circles for so long, at so many m/s. Runs in the page. */
export async function driveInCircles({ ms, forward }: { ms: number; forward: number }): Promise<void> {
  const { farpoint } = window;
  const end = performance.now() + ms;
  while (performance.now() < end) {
    const { session, holder } = farpoint.state();
    if (session === 'live' && holder === 'nobody') farpoint.requestLease();
    // Let go from time to time: after an interruption, the robot wants the grip to be released once.
    await farpoint.drive({ forward, left: 0.5 }, 900);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}
