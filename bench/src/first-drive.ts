/** `pnpm bench first-drive`: what a newcomer's first drive is like on this computer, by the README's first command. */
import { execFileSync } from 'node:child_process';
import { availableParallelism } from 'node:os';
import { freePorts, ManagedProcess, processFolder, repositoryRoot } from '@farpoint/local-stack';
import { benchOptions, type OptionValues, option } from './bench-options.ts';
import { BusyLoops } from './busy-loops.ts';
import { FIRST_DRIVE_BROWSERS, openFirstDrive } from './first-drive-browser.ts';
import { type DriveFigures, driveFigures } from './first-drive-figures.ts';
import { driveAbout, pause } from './first-drive-hand.ts';
import { type Bench, printJson, printTable } from './report.ts';

const USAGE = `pnpm bench first-drive [--seconds 60] [--sizes 1280x720,1920x1080] [--busy 0] [--here] [--throttle 1]
  [--browser chromium] [--headset] [--json]

Clones the last commit, starts it by the README's first command, and drives the simulated robot about in a real browser
with real key presses, with nothing set: everything that a newcomer gets. Software renders where there is no GPU.

  --busy N      runs N busy loops beside it
  --here        uses this checkout as it is, and not a clone
  --throttle N  the page's main thread is N times slower (Chromium's own emulation)
  --browser B   chromium or firefox
  --headset     enters VR in an emulated headset, and drives with its right controller (Chromium)

obeyed is the share of the time with a grip held in which the robot did what it was told, without the time in which its
obstacle guard bounded it. view age is that of what is on the screen. long tasks keep the main thread for more than 50 ms.`;

const START_MS = 15 * 60_000;
const END_MS = 10_000;
/** Before the drive: somebody looks at the page. */
const LOOK_MS = 5000;

interface Row extends DriveFigures {
  size: string;
  /** Clouds that were drawn, and frames of the page, a second. */
  drawnFramesPerSecond: number;
  displayFramesPerSecond: number;
  /** Tasks of the page's main thread of more than 50 ms, a minute, and the longest, ms; `null` where the browser does not tell. */
  longTasks: { perMinute: number; longestMs: number } | null;
}

const OPTIONS = {
  seconds: option.number(60, { least: 1 }),
  sizes: option.list(
    [
      { width: 1280, height: 720 },
      { width: 1920, height: 1080 },
    ],
    option.of(undefined, 'WIDTHxHEIGHT', parseSize),
  ),
  busy: option.number(0),
  throttle: option.number(1, { least: 1 }),
  here: option.flag,
  browser: option.choice('chromium', FIRST_DRIVE_BROWSERS),
  headset: option.flag,
};
type Options = OptionValues<typeof OPTIONS>;

function parseSize(text: string): { width: number; height: number } | undefined {
  const [width, height] = text.split('x').map(Number);
  return width && height ? { width, height } : undefined;
}

export const bench: Bench = {
  name: 'first-drive',
  summary: 'a newcomer’s first drive on this computer',
  usage: USAGE,
  async run(argv) {
    const options = benchOptions(argv, OPTIONS);
    const { seconds, busy, throttle, browser, headset } = options;
    if (browser !== 'chromium' && (headset || throttle > 1))
      throw new Error('--headset and --throttle need Chromium');
    const rows = await driveAll(options);
    print(rows);
    if (options.json)
      printJson({
        bench: 'first-drive',
        seconds,
        busy,
        throttle,
        browser,
        headset,
        cores: availableParallelism(),
        rows,
      });
  },
};

/** Starts `pnpm dev`, and drives once at each size of the page. */
async function driveAll({
  seconds,
  busy,
  throttle,
  browser: kind,
  headset,
  here,
  sizes,
}: Options): Promise<Row[]> {
  const folder = here ? repositoryRoot : clone();
  let loops: BusyLoops | null = null;
  let stack: ManagedProcess | null = null;
  const rows: Row[] = [];
  try {
    stack = await startDev(folder);
    const address = await addressOf(stack);
    loops = new BusyLoops(busy);
    for (const viewport of sizes) {
      const size = `${viewport.width}x${viewport.height}`;
      console.error(`${size}, ${seconds} s`);
      rows.push({ size, ...(await firstDrive(address, { kind, viewport, throttle, headset }, seconds)) });
    }
  } finally {
    loops?.stop();
    if (stack !== null) await endGroup(stack);
  }
  return rows;
}

async function startDev(folder: string): Promise<ManagedProcess> {
  const [port] = (await freePorts(1)) as [number];
  console.error(`npx -y pnpm@12 dev, in ${folder}`);
  return ManagedProcess.start({
    name: 'dev',
    command: ['npx', '-y', 'pnpm@12', 'dev', '--port', String(port)],
    cwd: folder,
    readyUrl: `http://localhost:${port}/`,
    readyTimeoutMs: START_MS,
  });
}

function print(rows: readonly Row[]): void {
  printTable(
    [
      'page',
      'metres',
      'held, s',
      'guarded, s',
      'obeyed',
      'view age p50',
      'p95, ms',
      'clouds/s',
      'frames/s',
      'grips lost',
      'long tasks/min',
      'longest, ms',
    ],
    rows.map((row) => [
      row.size,
      row.metres,
      row.heldS,
      row.guardedS,
      row.obeyedShare,
      row.viewAgeMs.p50,
      row.viewAgeMs.p95,
      row.drawnFramesPerSecond,
      row.displayFramesPerSecond,
      row.gripsLost,
      row.longTasks?.perMinute ?? '–',
      row.longTasks?.longestMs ?? '–',
    ]),
  );
  for (const { size, whyNotS } of rows) console.log(`${size}: not obeyed, s: ${JSON.stringify(whyNotS)}`);
}

/** @returns a fresh clone of the last commit */
function clone(): string {
  const folder = processFolder();
  if (execFileSync('git', ['status', '--porcelain'], { cwd: repositoryRoot, encoding: 'utf8' }).trim() !== '')
    console.error(
      'this checkout has changes that are not committed: they are not in the clone (--here uses them)',
    );
  execFileSync('git', ['clone', '--quiet', '--depth', '1', `file://${repositoryRoot}`, folder]);
  return folder;
}

/** As Ctrl-C in a terminal does: the launchers between this and the command pass no other signal on. */
async function endGroup(stack: ManagedProcess): Promise<void> {
  const signal = (name: NodeJS.Signals | 0): boolean => {
    try {
      return process.kill(-stack.pid, name);
    } catch {
      return false;
    }
  };
  signal('SIGINT');
  const deadlineMs = performance.now() + END_MS;
  while (signal(0) && performance.now() < deadlineMs)
    await new Promise((resolve) => setTimeout(resolve, 100));
  signal('SIGKILL');
}

/** The address that the command tells people to open. */
async function addressOf(dev: ManagedProcess): Promise<string> {
  for (;;) {
    const found = /Open {2}(http\S+)/.exec(dev.output)?.[1];
    if (found !== undefined) return found;
    if (!dev.running) throw new Error(`dev has ended:\n${dev.output}`);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}

async function firstDrive(
  address: string,
  how: Parameters<typeof openFirstDrive>[1],
  seconds: number,
): Promise<Omit<Row, 'size'>> {
  const { page, hold, close } = await openFirstDrive(address, how);
  try {
    await pause(LOOK_MS);
    const before = await page.evaluate(() => {
      window.farpoint.recordDrive(true);
      const tells = PerformanceObserver.supportedEntryTypes.includes('longtask');
      window.benchLongMs = tells ? [] : null;
      if (tells)
        new PerformanceObserver((list) => {
          for (const { duration } of list.getEntries()) window.benchLongMs?.push(duration);
        }).observe({ type: 'longtask' });
      return { frames: window.farpoint.stats().framesDrawn, atMs: performance.now() };
    }, null);
    await driveAbout(page, hold, seconds * 1000);
    const after = await page.evaluate(() => {
      const { framesDrawn, displayFramesPerSecond } = window.farpoint.stats();
      window.farpoint.recordDrive(false);
      const recording = window.farpoint.recordedDrive();
      const { benchLongMs: longMs = null } = window;
      return { frames: framesDrawn, displayFramesPerSecond, recording, longMs, atMs: performance.now() };
    }, null);
    if (after.recording === null) throw new Error('the page has recorded nothing');
    const elapsedS = (after.atMs - before.atMs) / 1000;
    return {
      ...driveFigures(after.recording),
      drawnFramesPerSecond: Number(((after.frames - before.frames) / elapsedS).toFixed(1)),
      displayFramesPerSecond: Number(after.displayFramesPerSecond.toFixed(1)),
      longTasks: after.longMs === null ? null : longTasksOf(after.longMs, elapsedS),
    };
  } finally {
    await close();
  }
}

function longTasksOf(tookMs: readonly number[], elapsedS: number): { perMinute: number; longestMs: number } {
  const perMinute = Number(((tookMs.length * 60) / elapsedS).toFixed(1));
  return { perMinute, longestMs: Math.round(Math.max(0, ...tookMs)) };
}

declare global {
  interface Window {
    /** How long each long task took, ms; `null` where the browser does not tell. */
    benchLongMs?: number[] | null;
  }
}
