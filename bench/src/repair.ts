/** `pnpm bench repair`: on a lossy link, what each browser requests again, what it gets, and what it finally lacks. */
import { join } from 'node:path';
import {
  chromiumLaunchOptions,
  EmulatedLink,
  FirefoxBrowser,
  LocalStack,
  repositoryRoot,
} from '@farpoint/local-stack';
import type { PageStats } from '@farpoint/webxr/test-api';
import { chromium } from '@playwright/test';
import { benchOptions, option } from './bench-options.ts';
import { buildPage } from './live-stack.ts';
import { type Bench, printJson, printTable } from './report.ts';

const USAGE = `pnpm bench repair [--loss 0.01,0.05] [--rtt-ms 40] [--mbps 20] [--seconds 15] [--robot="--mode points64 …"] [--json]

Real robot (simulated office), signaling, and Chromium and then Firefox, over an emulated link that loses packets both ways.
--robot passes further options to the robot. Repaired packets are those that were missing, requested and resent.`;

const WARM_UP_MS = 5000;
const BROWSERS = ['chromium', 'firefox'] as const;

interface Visit {
  stats(): Promise<PageStats>;
  close(): Promise<void>;
}

export const bench: Bench = {
  name: 'repair',
  summary: 'lost packets, requested and resent, in Chromium and in Firefox',
  usage: USAGE,
  async run(argv) {
    const {
      loss: losses,
      seconds,
      json,
      ...options
    } = benchOptions(argv, {
      loss: option.list([0.01, 0.05], option.number(undefined)),
      rttMs: option.number(40),
      mbps: option.number(20, { least: 1 }),
      seconds: option.number(15, { least: 1 }),
      robot: option.text(''),
    });
    const link = ['--rtt-ms', String(options.rttMs), '--rate-mbps', String(options.mbps)];
    const robot = options.robot.split(' ').filter((word) => word !== '');
    buildPage();
    const results = [];
    for (const loss of losses) {
      for (const browser of BROWSERS) {
        console.error(`${seconds} s in ${browser}, ${loss * 100} % lost`);
        results.push(await measure(browser, loss, [...link, '--loss', String(loss)], robot, seconds));
      }
    }
    printTable(
      [
        'browser',
        'loss, %',
        'frames/s',
        'packets',
        'missed for good',
        'share, %',
        'resent',
        'asked too late',
      ],
      results.map((r) => [
        r.browser,
        r.loss * 100,
        r.framesPerSecond,
        r.packets,
        r.missed,
        r.missedPercent,
        r.resent,
        r.tooLate,
      ]),
    );
    if (json) printJson({ bench: 'repair', seconds, link, robot, results });
  },
};

async function measure(
  browser: (typeof BROWSERS)[number],
  loss: number,
  linkArgs: string[],
  robotArgs: string[],
  seconds: number,
) {
  const stack = await LocalStack.start({
    webRoot: join(repositoryRoot, 'apps', 'webxr', 'dist-testing'),
    robots: [],
    env: { FARPOINT_LOG_LEVEL: 'warn' },
  });
  const cleanups: (() => Promise<unknown>)[] = [() => stack.stop()];
  try {
    const link = await EmulatedLink.start(stack, { args: linkArgs });
    cleanups.push(() => link.stop());
    await stack.startRobot({
      id: 'sim-1',
      name: 'Simulated robot',
      args: ['--source', 'sim', '--sim-seed', '1', '--signaling', link.signalingUrl, ...robotArgs],
    });
    const visit = await open(browser, `${stack.webUrl}?robot=sim-1&canvas=64x36&measure=1&every=8`);
    cleanups.push(() => visit.close());
    while ((await visit.stats()).framesDrawn < 5) await pause(100);
    await pause(WARM_UP_MS);
    const look = async () => ({
      page: await visit.stats(),
      robot: await repairs(stack.robotAdminUrl('sim-1')),
    });
    const before = await look();
    await pause(seconds * 1000);
    const after = await look();
    const received = after.page.packetsReceived - before.page.packetsReceived;
    const missed = after.page.packetsLost - before.page.packetsLost;
    return {
      browser,
      loss,
      framesPerSecond: Number(after.page.framesPerSecond.toFixed(1)),
      packets: received + missed,
      missed,
      missedPercent: Number(((100 * missed) / (received + missed)).toFixed(2)),
      resent: after.robot.resent - before.robot.resent,
      tooLate: after.robot.tooLate - before.robot.tooLate,
    };
  } finally {
    for (const cleanup of cleanups.reverse()) await cleanup();
  }
}

async function open(browser: (typeof BROWSERS)[number], url: string): Promise<Visit> {
  if (browser === 'firefox') {
    const firefox = await FirefoxBrowser.launch();
    const page = await firefox.newPage();
    await page.goto(url);
    await page.waitForFunction(() => window.farpoint !== undefined);
    return { stats: () => page.evaluate(() => window.farpoint.stats()), close: () => firefox.close() };
  }
  const launched = await chromium.launch(chromiumLaunchOptions());
  const page = await launched.newPage();
  await page.goto(url);
  await page.waitForFunction(() => window.farpoint !== undefined);
  return { stats: () => page.evaluate(() => window.farpoint.stats()), close: () => launched.close() };
}

async function repairs(adminUrl: string): Promise<{ resent: number; tooLate: number }> {
  const text = await (await fetch(`${adminUrl}/metrics`)).text();
  const value = (name: string) => {
    const line = text.split('\n').find((one) => one.startsWith(`farpoint_robot_${name} `));
    return Number(line?.split(' ').at(-1) ?? 0);
  };
  return { resent: value('packets_resent'), tooLate: value('resends_refused{reason="too-late"}') };
}

function pause(ms: number): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, ms));
}
