/** `pnpm bench load`: from an address to a page that can be used, over a link of a given rate. */
import { join } from 'node:path';
import { chromiumLaunchOptions, LocalStack, repositoryRoot } from '@farpoint/local-stack';
import { type Browser, type CDPSession, chromium, type Page } from '@playwright/test';
import { benchOptions, option } from './bench-options.ts';
import { buildPage } from './live-stack.ts';
import { type Bench, printJson, printTable } from './report.ts';
import { distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench load [--mbps 10] [--rtt 40] [--count 5] [--json]

The signaling service serves the built page, as it is deployed, to a Chromium that has nothing of it in its cache, over a link of
so many Mbit/s and ms of round trip (Chromium's own emulation of a network). Each time in ms from the beginning of the
navigation:

  painted      the first text or picture is on the screen
  interactive  the robot can be chosen, and no task of more than 50 ms follows within half a second
  picture      after choosing it at once: its first points are drawn

received is what the page itself has loaded by then, without what its workers have.`;

const ROBOT = 'sim-1';
/** Until something happens at all, ms. */
const WAIT_MS = 60_000;
/** A task longer than this makes a hand wait, ms: https://www.w3.org/TR/longtasks-1/ */
const LONG_MS = 50;
/** Nothing of that kind for so long: the page is at rest, ms. Chosen: ten times the limit. */
const QUIET_MS = 500;

interface Link {
  mbps: number;
  rttMs: number;
}

interface Load {
  paintedMs: number;
  interactiveMs: number;
  pictureMs: number;
  receivedKb: number;
}

export const bench: Bench = {
  name: 'load',
  summary: 'from an address to a page that can be used, over a link of a given rate',
  usage: USAGE,
  async run(argv) {
    const { mbps, rtt, count, json } = benchOptions(argv, {
      mbps: option.number(10, { least: 0.1 }),
      rtt: option.number(40),
      count: option.number(5, { least: 1 }),
    });
    console.error('building the page');
    buildPage('production');
    const stack = await LocalStack.start({
      webRoot: join(repositoryRoot, 'apps', 'webxr', 'dist'),
      robots: [{ id: ROBOT, name: 'Simulated robot' }],
      env: { FARPOINT_LOG_LEVEL: 'warn' },
    });
    const browser = await chromium.launch(chromiumLaunchOptions());
    const loads: Load[] = [];
    try {
      for (let n = 0; n < count; n++) loads.push(await load(browser, stack.webUrl, { mbps, rttMs: rtt }));
    } finally {
      await browser.close();
      await stack.stop();
    }
    const figures = (read: (load: Load) => number) => {
      const { p50, max } = rounded(distribution(loads.map(read)), 0);
      return { p50, max };
    };
    const result = {
      paintedMs: figures(({ paintedMs }) => paintedMs),
      interactiveMs: figures(({ interactiveMs }) => interactiveMs),
      pictureMs: figures(({ pictureMs }) => pictureMs),
      receivedKb: figures(({ receivedKb }) => receivedKb),
    };
    printTable(
      ['', 'median', 'max'],
      Object.entries(result).map(([name, { p50, max }]) => [name, p50, max]),
    );
    if (json) printJson({ bench: 'load', mbps, rttMs: rtt, count, ...result });
  },
};

async function load(browser: Browser, address: string, link: Link): Promise<Load> {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 } });
  try {
    const page = await context.newPage();
    const devTools = await context.newCDPSession(page);
    await narrow(devTools, link);
    const received = countBytes(devTools);
    // A first session shows the first drive, whose code would load beside the first picture.
    await page.addInitScript(() => localStorage.setItem('farpoint.tour', 'shown'));
    await page.addInitScript(noteTasks);
    await page.goto(address, { waitUntil: 'commit' });
    const robot = page.locator(`#robot-list button[data-robot="${ROBOT}"]`);
    await robot.waitFor({ timeout: WAIT_MS });
    const { paintedMs, interactiveMs } = await page.evaluate(whenAtRest, [LONG_MS, QUIET_MS] as const);
    const receivedKb = received() / 1000;
    await robot.click();
    return { paintedMs, interactiveMs, pictureMs: await pictureMs(page), receivedKb };
  } finally {
    await context.close();
  }
}

async function narrow(devTools: CDPSession, { mbps, rttMs }: Link): Promise<void> {
  const bytesPerSecond = (mbps * 1e6) / 8;
  await devTools.send('Network.enable');
  await devTools.send('Network.emulateNetworkConditions', {
    offline: false,
    latency: rttMs,
    downloadThroughput: bytesPerSecond,
    uploadThroughput: bytesPerSecond,
  });
}

/** @returns what says how much has come by now, as it came */
function countBytes(devTools: CDPSession): () => number {
  let bytes = 0;
  devTools.on('Network.loadingFinished', ({ encodedDataLength }) => {
    bytes += encodedDataLength;
  });
  return () => bytes;
}

declare global {
  interface Window {
    /** When tasks that were long have ended, ms since the navigation, and how long they were. */
    benchTasks: { endedMs: number; tookMs: number }[];
  }
}

/** Runs in the page before its own scripts. */
function noteTasks(): void {
  window.benchTasks = [];
  new PerformanceObserver((list) => {
    for (const { startTime, duration } of list.getEntries())
      window.benchTasks.push({ endedMs: startTime + duration, tookMs: duration });
  }).observe({ type: 'longtask', buffered: true });
}

/** Runs in the page once the robot is listed. @returns when it was painted, and when it came to rest after this */
async function whenAtRest([longMs, quietMs]: readonly [number, number]) {
  let restMs = performance.now();
  while (performance.now() - restMs < quietMs) {
    await new Promise((resolve) => setTimeout(resolve, 50));
    for (const { endedMs, tookMs } of window.benchTasks)
      if (tookMs > longMs) restMs = Math.max(restMs, endedMs);
  }
  const paint = performance.getEntriesByName('first-contentful-paint')[0];
  return { paintedMs: paint?.startTime ?? Number.NaN, interactiveMs: restMs };
}

/** From choosing the robot to its first picture. The deployed page tells nobody, so its figures are read. */
async function pictureMs(page: Page): Promise<number> {
  return page.evaluate(async () => {
    const beganMs = performance.now();
    const rows = () => [...document.querySelectorAll('#facts dt')];
    const points = () =>
      rows().find((row) => row.textContent === 'Points')?.nextElementSibling?.textContent ?? '';
    while (!/[1-9]/.test(points())) await new Promise((resolve) => requestAnimationFrame(resolve));
    return performance.now() - beganMs;
  });
}
