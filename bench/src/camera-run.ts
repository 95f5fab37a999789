/** One run of `pnpm bench cameras`: the real programs, from cameras to the page, with a driving operator. */
import { writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { processFolder } from '@farpoint/local-stack';
import type { Page } from '@playwright/test';
import type { BenchCamera } from './camera-list.ts';
import { type AskedShares, type SharePair, sharesSeen } from './camera-shares.ts';
import { commandDelays } from './command-delay.ts';
import { coresBetween, cpuSecondsOfTree } from './cpu-time.ts';
import { type LatencySeries, latencySeries } from './latency-series.ts';
import { queueQuantiles } from './link-analysis.ts';
import { clockOffsetOf, readRobotSamples, readUplink, scrape } from './link-run.ts';
import { type LiveStack, type LiveStackOptions, startLiveStack } from './live-stack.ts';
import { monotonicMs, wait } from './measured-span.ts';
import { driveInCircles } from './page.ts';
import { type PresentationFigures, presentationFigures } from './presentation-figures.ts';
import { type Distribution, distribution } from './stats.ts';

export interface CameraSetup {
  cameras: readonly BenchCamera[];
  synchronised: boolean;
  /** How the page receives videos; `null`: as suits the browser best. */
  receiver: string | null;
  /** A capacity trace of the uplink; `null`: no link between robot and page. */
  trace: string | null;
  seconds: number;
  encoder: string;
  /** What the cameras show. */
  content: 'plain' | 'noise';
  /** Points of each cloud beside the cameras; `null`: the whole cloud, as much as the link carries. */
  points: number | null;
  cloudsPerS: number;
  /** Of the point view, `160x90`. */
  canvas: string;
  /** How the operator divides the link; `null`: as the robot does unasked. */
  shares: AskedShares | null;
  /** Whether the page hears the robot's microphone, a test tone. */
  sound: boolean;
}

export interface CameraRun extends PresentationFigures {
  presentations: number;
  /** Pictures that encoders skipped, and pictures that arrived and were not shown, by camera. */
  dropped: number[];
  /** How long pictures that had arrived waited for others, ms. */
  addedBySyncMs: Distribution | null;
  /** From the page to the robot, beyond the link's own delay, ms. */
  commandDelayMs: Distribution;
  commands: number;
  commandsRefused: number;
  /** Of the emulated link; `null` without one. */
  queueMs: Distribution | null;
  /** Cores, encoders included. */
  robotCpu: number | null;
  browserCpu: number | null;
  /** As the page has it; `null` if the browser cannot read videos. */
  receiver: string | null;
  /** Encoded during the measurement, all cameras together. */
  keyFrames: number;
  shares: SharePair[] | null;
  /** Packets of sound a second; `null` without sound. */
  soundPacketsPerS: number | null;
  series: LatencySeries[];
}

/** Round trip of the emulated link, ms: that of the paper's field tests. */
export const LINK_RTT_MS = 42.4;
const ROBOT = 'sim-1';
const WARM_UP_MS = 5000;
/** With a whole cloud and shares, until rates have settled. */
const LONG_WARM_UP_MS = 15_000;
const MOST_PRESENTATIONS = 60_000;
const SETTLE_MS = 500;
/** Pictures that few bits show well, and noise, which takes any rate. */
const PATTERNS = { plain: ['pinwheel', 'ball', 'smpte'], noise: ['snow'] } as const;

/** The robot's configuration, and files that the programs of a run write. */
interface CameraFiles {
  config: string;
  link: string;
  stats: string;
  commands: string;
}

/** @param log takes lines about the progress */
export async function runCameras(setup: CameraSetup, log: (line: string) => void): Promise<CameraRun> {
  const folder = processFolder();
  const files: CameraFiles = {
    config: join(folder, 'c.yaml'),
    link: join(folder, 'link.jsonl'),
    stats: join(folder, 'streams.jsonl'),
    commands: join(folder, 'commands.csv'),
  };
  const robot = { videos: cameraOptions(setup), ...soundOptions(setup) };
  writeFileSync(files.config, JSON.stringify({ robot }));
  const live = await startLiveStack(stackOptions(setup, files, log));
  try {
    live.link?.tell({ type: 'reset' });
    await setUpPage(live.page, setup);
    await wait(setup.points === null ? LONG_WARM_UP_MS : WARM_UP_MS);
    log(`${setup.seconds} s`);
    const record = await drive(live, setup, files);
    await wait(SETTLE_MS);
    await live.stack.robot(ROBOT).stop();
    return figuresOf(setup, record, files);
  } finally {
    await live.close();
  }
}

function stackOptions(
  setup: CameraSetup,
  { config, link, stats }: CameraFiles,
  log: (line: string) => void,
): LiveStackOptions {
  const { trace } = setup;
  return {
    robot: {
      id: ROBOT,
      name: 'Robot with cameras',
      args: ['--config', config, '--measure', dirname(stats), ...cloudArgs(setup)],
    },
    canvas: setup.canvas,
    query: `barcode=1&video=${setup.receiver ?? ''}`,
    stored: { 'farpoint.settings': { synchronised: setup.synchronised } },
    ...(trace === null ? {} : { connectAtMbps: 20, link: linkSpec(trace, link) }),
    log,
  };
}

/** Divides the link and turns the sound on, if the setup asks for it. */
async function setUpPage(page: Page, { shares, sound }: CameraSetup): Promise<void> {
  if (shares !== null) await page.evaluate((shares) => window.farpoint.shareLink(shares), shares);
  // By key: the page is too small for its buttons.
  if (sound) await page.getByRole('button', { name: 'Sound', exact: true }).press('Enter');
}

/** Counts since the robot started; lists have a count for each camera. */
interface Counters {
  skipped: number[];
  bytes: number[];
  /** All streams of the robot together. */
  bytesSent: number;
  keyFrames: number[];
  soundPackets: number;
  /** Processor time, s; `null` without /proc. */
  cpu: number | null;
  browserCpu: number | null;
  atMs: number;
}

async function readCounters(
  { stack, browserPid }: LiveStack,
  setup: CameraSetup,
  stats: string,
): Promise<Counters> {
  const cameras = setup.cameras.length;
  const adminUrl = stack.robotAdminUrl(ROBOT);
  return {
    skipped: await byCamera(adminUrl, 'frames_skipped', cameras),
    bytes: await byCamera(adminUrl, 'bytes', cameras),
    bytesSent: readRobotSamples(stats).at(-1)?.bytesSent ?? 0,
    keyFrames: await byCamera(adminUrl, 'key_frames', cameras),
    soundPackets: setup.sound ? await soundPackets(adminUrl) : 0,
    cpu: cpuSecondsOfTree(stack.robot(ROBOT).pid),
    browserCpu: cpuSecondsOfTree(browserPid),
    atMs: monotonicMs(),
  };
}

/** The records of one drive. */
interface CameraRecord {
  before: Counters;
  after: Counters;
  rows: ReturnType<Window['farpoint']['recordedPresentations']>;
  videos: ReturnType<Window['farpoint']['stats']>['videos'];
  /** What to add to the page's clock to get the robot's, ms. */
  offsetMs: number;
}

async function drive(live: LiveStack, setup: CameraSetup, { stats }: CameraFiles): Promise<CameraRecord> {
  const { page } = live;
  await page.evaluate((capacity) => {
    window.farpoint.resetStats();
    window.farpoint.recordPresentations(capacity);
  }, MOST_PRESENTATIONS);
  const before = await readCounters(live, setup, stats);
  await page.evaluate(driveInCircles, { ms: setup.seconds * 1000, forward: 0.3 });
  const after = await readCounters(live, setup, stats);
  const shown = await page.evaluate(() => ({
    rows: window.farpoint.recordedPresentations(),
    videos: window.farpoint.stats().videos,
  }));
  return { before, after, ...shown, offsetMs: await clockOffsetOf(page) };
}

function figuresOf(setup: CameraSetup, record: CameraRecord, files: CameraFiles): CameraRun {
  const { cameras, trace, shares: asked, seconds } = setup;
  const { before, after, rows, videos } = record;
  const delays = commandDelays(files.commands, record.offsetMs, trace === null ? 0 : LINK_RTT_MS / 2, [
    before.atMs,
    after.atMs,
  ]);
  const bytes = after.bytes.map((each, i) => each - (before.bytes[i] ?? 0));
  const unshown = cameras.map((_, i) => unshownOf(videos, i));
  return {
    ...presentationFigures(
      rows,
      cameras.map(({ framesPerS }) => framesPerS),
      setup.cloudsPerS,
    ),
    presentations: rows.length,
    dropped: after.skipped.map((each, i) => each - (before.skipped[i] ?? 0) + (unshown[i] as number)),
    addedBySyncMs: videos.heldMs,
    commandDelayMs: distribution(delays.accepted),
    commands: delays.accepted.length,
    commandsRefused: delays.refused,
    queueMs: trace === null ? null : queueQuantiles(readUplink(files.link)),
    robotCpu: coresBetween(before.cpu, after.cpu, after.atMs - before.atMs),
    browserCpu: coresBetween(before.browserCpu, after.browserCpu, after.atMs - before.atMs),
    receiver: videos.receiver,
    keyFrames: after.keyFrames.reduce((sum, each, i) => sum + each - (before.keyFrames[i] ?? 0), 0),
    shares: asked === null ? null : sharesSeen(asked, after.bytesSent - before.bytesSent, bytes),
    soundPacketsPerS: setup.sound ? (after.soundPackets - before.soundPackets) / seconds : null,
    series: latencySeries(rows, cameras.length),
  };
}

/** Pictures of a camera that arrived and were not shown. */
function unshownOf({ sources }: CameraRecord['videos'], camera: number): number {
  const drops = sources.find(({ source }) => source === `video:${camera}`)?.drops;
  return drops === undefined ? 0 : Object.values(drops).reduce((sum, count) => sum + count, 0);
}

function cameraOptions({ cameras, encoder, content }: CameraSetup) {
  const patterns = PATTERNS[content];
  return cameras.map(({ width, height, framesPerS, kbitPerS }, i) => ({
    name: cameraName(i),
    source: { kind: 'test', pattern: patterns[i % patterns.length], width, height, framesPerS },
    encoder,
    width,
    height,
    framesPerS,
    kbitPerS,
  }));
}

function soundOptions({ sound }: CameraSetup) {
  return sound ? { sound: { microphone: { source: { kind: 'test' } } } } : {};
}

function cloudArgs({ points, cloudsPerS, trace }: CameraSetup): string[] {
  const fps = ['--fps', String(cloudsPerS)];
  if (points === null) return fps;
  const rate = trace === null ? ['--rate-control', 'fixed', '--bitrate-mbps', '50'] : [];
  return ['--sim-size', '64', ...fps, '--mode', 'points64', '--max-points', String(points), ...rate];
}

function linkSpec(trace: string, statsFile: string) {
  return {
    args: ['--up-trace', trace, '--down-rate-mbps', '50', '--rtt-ms', String(LINK_RTT_MS)],
    statsFile,
    env: { FARPOINT_LOG_LEVEL: 'warn' },
  };
}

async function soundPackets(adminUrl: string): Promise<number> {
  const text = await (await fetch(`${adminUrl}/metrics`)).text();
  return Number(/^farpoint_robot_sound_packets_total (\d+)$/m.exec(text)?.[1]);
}

/** A counter of the robot's videos, by camera. */
async function byCamera(adminUrl: string, name: string, cameras: number): Promise<number[]> {
  const counts = await scrape(adminUrl, `farpoint_robot_video_${name}_total`, 'camera');
  return Array.from({ length: cameras }, (_, i) => counts[cameraName(i)] ?? 0);
}

function cameraName(index: number): string {
  return `Camera ${index + 1}`;
}
