/** `pnpm bench janus`: what viewers at Janus cost the robot. */
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import {
  chromiumLaunchOptions,
  findJanus,
  JANUS_REMEDY,
  JanusServer,
  LocalStack,
  processFolder,
  repositoryRoot,
} from '@farpoint/local-stack';
import { JanusViewer } from '@farpoint/robot-node/testing/janus';
import { availableEncoders } from '@farpoint/video';
import type { WatchStats } from '@farpoint/webxr/watch-api';
import { type Browser, chromium, type Page } from '@playwright/test';
import { benchOptions, option } from './bench-options.ts';
import { coresBetween, cpuSecondsOfTree } from './cpu-time.ts';
import { buildPage } from './live-stack.ts';
import { wait } from './measured-span.ts';
import { type Bench, printJson, printTable } from './report.ts';

const USAGE = `pnpm bench janus [options]

Real robot, Janus and headless Chromium. The robot feeds Janus with two cameras and its clouds. One viewer is a page in the
browser, the others are light: they decrypt and count packets.

  --viewers 1,10      how many watch, one run for each
  --seconds 20        duration of a run
  --mbps 3            of the broadcast
  --encoder x264enc   or another one that \`pnpm robot doctor\` lists
  --json

uplinkBytesPerS: all headers counted. robotCpu: cores, encoders included. framesPerS: of the first camera, the page's first.
spreadMs: between the earliest and the latest capture of the videos that the page shows at once. cloudAheadMs: from the capture
of the videos that are shown to that of the cloud that is drawn with them.`;

const ROBOT = 'sim-1';
const WARM_UP_MS = 5000;
const CAMERA = { width: 640, height: 480, framesPerS: 15 };

interface RunOptions {
  viewers: number;
  seconds: number;
  mbps: number;
  encoder: string;
}

export const bench: Bench = {
  name: 'janus',
  summary: 'what viewers at Janus cost the robot: uplink, processor, frame rates',
  usage: USAGE,
  async run(argv) {
    const { viewers, json, ...options } = benchOptions(argv, {
      viewers: option.list([1, 10], option.number(undefined, { least: 1 })),
      seconds: option.number(20, { least: 1 }),
      mbps: option.number(3, { least: 0.1 }),
      encoder: option.text('x264enc'),
    });
    if (findJanus() === null) throw new Error(`Janus is not installed: ${JANUS_REMEDY}`);
    await availableEncoders();
    console.error('building the page');
    buildPage();
    const runs: Awaited<ReturnType<typeof measure>>[] = [];
    for (const count of viewers) {
      console.error(`${count} viewers`);
      runs.push(await measure({ viewers: count, ...options }));
    }
    printTable(
      [
        'viewers',
        'uplink, bytes/s',
        'robot, cores',
        'frames/s: page',
        'others, least',
        'spread p50, ms',
        'p99',
        'cloud ahead p50, ms',
        'p95',
      ],
      runs.map(({ viewers, uplinkBytesPerS, robotCpu, framesPerS, spreadMs, cloudAheadMs }) => [
        viewers,
        Math.round(uplinkBytesPerS),
        robotCpu,
        framesPerS[0],
        framesPerS.length > 1 ? Math.min(...framesPerS.slice(1)) : null,
        spreadMs?.p50,
        spreadMs?.p99,
        cloudAheadMs?.p50,
        cloudAheadMs?.p95,
      ]),
    );
    if (json) printJson({ bench: 'janus', ...options, camera: CAMERA, runs });
  },
};

async function measure(options: RunOptions) {
  const folder = processFolder();
  const janus = await JanusServer.start();
  const viewers: JanusViewer[] = [];
  let stack: LocalStack | null = null;
  let browser: Browser | null = null;
  try {
    const config = join(folder, 'farpoint.yaml');
    writeFileSync(config, configuration(options, janus));
    stack = await LocalStack.start({
      webRoot: join(repositoryRoot, 'apps', 'webxr', 'dist-testing'),
      robots: [{ id: ROBOT, name: 'Rover', args: ['--config', config, '--sim-size', '96', '--fps', '15'] }],
      env: { FARPOINT_LOG_LEVEL: 'warn' },
    });
    browser = await chromium.launch(chromiumLaunchOptions());
    const page = await browser.newPage({ viewport: { width: 320, height: 180 } });
    await page.goto(`${stack.webUrl}watch.html?janus=${janus.url}`);
    await page.waitForFunction(() => (window.farpointWatch?.stats().videos.videos[0]?.frames ?? 0) > 10);
    for (let i = 1; i < options.viewers; i++)
      viewers.push(await JanusViewer.watch({ url: janus.url, mountpoint: 1, light: true }));
    for (const viewer of viewers) await viewer.until(() => framesOf(viewer) > 5);
    await wait(WARM_UP_MS);
    return { viewers: options.viewers, ...(await watch(stack, page, viewers, options.seconds)) };
  } finally {
    await Promise.all(viewers.map((viewer) => viewer.close()));
    await browser?.close();
    await stack?.stop();
    await janus.stop();
  }
}

/** The robot's configuration: JSON is valid YAML. */
function configuration({ mbps, encoder }: RunOptions, janus: JanusServer): string {
  const cameras = ['pinwheel', 'ball'].map((pattern) => ({
    name: pattern,
    encoder,
    ...CAMERA,
    kbitPerS: 600,
    source: { kind: 'test', pattern, ...CAMERA },
  }));
  const broadcast = { janus: janus.url, adminKey: janus.adminKey, mbps };
  return JSON.stringify({ robot: { videos: cameras, broadcast } });
}

/** Measures while all viewers watch. @param viewers light ones, beside the page */
async function watch(stack: LocalStack, page: Page, viewers: readonly JanusViewer[], seconds: number) {
  const shown = (): Promise<WatchStats | undefined> => page.evaluate(() => window.farpointWatch?.stats());
  const { pid } = stack.robot(ROBOT);
  const admin = stack.robotAdminUrl(ROBOT);
  await page.evaluate(() => window.farpointWatch?.resetDistributions());
  const before = { cpu: cpuSecondsOfTree(pid), bytes: await bytesSent(admin), shown: await shown() };
  const framesBefore = viewers.map(framesOf);
  const fromMs = performance.now();
  await wait(seconds * 1000);
  const elapsedS = (performance.now() - fromMs) / 1000;
  const after = { cpu: cpuSecondsOfTree(pid), bytes: await bytesSent(admin), shown: await shown() };
  const pageFrames = (stats: WatchStats | undefined): number => stats?.videos.videos[0]?.frames ?? 0;
  const frames = [
    pageFrames(after.shown) - pageFrames(before.shown),
    ...viewers.map((viewer, i) => framesOf(viewer) - (framesBefore[i] as number)),
  ];
  return {
    uplinkBytesPerS: (after.bytes - before.bytes) / elapsedS,
    robotCpu: coresBetween(before.cpu, after.cpu, elapsedS * 1000),
    framesPerS: frames.map((each) => Math.round((each / elapsedS) * 10) / 10),
    spreadMs: after.shown?.videos.spreadMs ?? null,
    cloudAheadMs: after.shown?.cloud.aheadMs ?? null,
    cloudHeldMs: after.shown?.cloud.heldMs ?? null,
    sources: after.shown?.videos.sources.map(({ source, state, behindMs }) => ({
      source,
      state,
      behindMs,
    })),
  };
}

function framesOf(viewer: JanusViewer): number {
  return viewer.videos.get('v0')?.frames ?? 0;
}

async function bytesSent(adminUrl: string): Promise<number> {
  const text = await (await fetch(`${adminUrl}/metrics`)).text();
  return Number(/^farpoint_robot_broadcast_bytes_total (\S+)$/m.exec(text)?.[1] ?? 0);
}
