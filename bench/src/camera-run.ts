/** One run of `pnpm bench cameras`: the real programs, from cameras to the page, with a driving operator. */
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { BenchCamera } from './camera-list.ts';
import { type AskedShares, type SharePair, sharesSeen } from './camera-shares.ts';
import { commandDelays } from './command-delay.ts';
import { coresBetween, cpuSecondsOfTree } from './cpu-time.ts';
import { type LatencySeries, latencySeries } from './latency-series.ts';
import { queueQuantiles } from './link-analysis.ts';
import { clockOffsetOf, readRobotSamples, readUplink, scrape } from './link-run.ts';
import { startLiveStack } from './live-stack.ts';
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

/** @param log takes lines about the progress */
export async function runCameras(setup: CameraSetup, log: (line: string) => void): Promise<CameraRun> {
  const { cameras, trace, seconds } = setup;
  const folder = mkdtempSync(join(tmpdir(), 'farpoint-cameras-'));
  const file = (name: string) => join(folder, name);
  const [config, link, stats, commands] = ['c.yaml', 'link.jsonl', 'stats.jsonl', 'commands.csv'].map(
    file,
  ) as [string, string, string, string];
  writeFileSync(config, JSON.stringify({ robot: { videos: cameraOptions(setup), ...soundOptions(setup) } }));
  const live = await startLiveStack({
    robot: {
      id: ROBOT,
      name: 'Robot with cameras',
      args: ['--config', config, '--stats', stats, '--command-log', commands, ...cloudArgs(setup)],
    },
    canvas: setup.canvas,
    query: `barcode=1&sync=${setup.synchronised ? 1 : 0}&video=${setup.receiver ?? ''}`,
    ...(trace === null ? {} : { connectAtMbps: 20, link: linkSpec(trace, link) }),
    log,
  });
  try {
    const { page, stack } = live;
    live.link?.tell({ type: 'reset' });
    const asked = setup.shares;
    if (asked !== null) await page.evaluate((shares) => window.farpoint.shareLink(shares), asked);
    // By key: the page is too small for its buttons.
    if (setup.sound) await page.getByRole('button', { name: 'Sound', exact: true }).press('Enter');
    await wait(setup.points === null ? LONG_WARM_UP_MS : WARM_UP_MS);
    const { pid } = stack.robot(ROBOT);
    const counters = async () => ({
      skipped: await byCamera(stack.robotAdminUrl(ROBOT), 'frames_skipped', cameras.length),
      bytes: await byCamera(stack.robotAdminUrl(ROBOT), 'bytes', cameras.length),
      bytesSent: readRobotSamples(stats).at(-1)?.bytesSent ?? 0,
      keyFrames: await byCamera(stack.robotAdminUrl(ROBOT), 'key_frames', cameras.length),
      soundPackets: setup.sound ? await soundPackets(stack.robotAdminUrl(ROBOT)) : 0,
      cpu: cpuSecondsOfTree(pid),
      browserCpu: cpuSecondsOfTree(live.browserPid),
      atMs: monotonicMs(),
    });
    log(`${seconds} s`);
    await page.evaluate((capacity) => {
      window.farpoint.resetStats();
      window.farpoint.recordPresentations(capacity);
    }, MOST_PRESENTATIONS);
    const before = await counters();
    await page.evaluate(driveInCircles, { ms: seconds * 1000, forward: 0.3 });
    const after = await counters();
    const { rows, figures } = await page.evaluate(() => ({
      rows: window.farpoint.recordedPresentations(),
      figures: window.farpoint.stats().videos,
    }));
    const offsetMs = await clockOffsetOf(page);
    await wait(SETTLE_MS);
    await live.stack.robot(ROBOT).stop();
    const unshown = cameras.map((_, i) => {
      const drops = figures.sources.find(({ source }) => source === `video:${i}`)?.drops;
      return drops === undefined ? 0 : Object.values(drops).reduce((sum, count) => sum + count, 0);
    });
    const delays = commandDelays(commands, offsetMs, trace === null ? 0 : LINK_RTT_MS / 2, [
      before.atMs,
      after.atMs,
    ]);
    const bytes = after.bytes.map((each, i) => each - (before.bytes[i] ?? 0));
    return {
      ...presentationFigures(
        rows,
        cameras.map(({ framesPerS }) => framesPerS),
        setup.cloudsPerS,
      ),
      presentations: rows.length,
      dropped: after.skipped.map((each, i) => each - (before.skipped[i] ?? 0) + (unshown[i] as number)),
      addedBySyncMs: figures.heldMs,
      commandDelayMs: distribution(delays.accepted),
      commands: delays.accepted.length,
      commandsRefused: delays.refused,
      queueMs: trace === null ? null : queueQuantiles(readUplink(link)),
      robotCpu: coresBetween(before.cpu, after.cpu, after.atMs - before.atMs),
      browserCpu: coresBetween(before.browserCpu, after.browserCpu, after.atMs - before.atMs),
      receiver: figures.receiver,
      keyFrames: after.keyFrames.reduce((sum, each, i) => sum + each - (before.keyFrames[i] ?? 0), 0),
      shares: asked === null ? null : sharesSeen(asked, after.bytesSent - before.bytesSent, bytes),
      soundPacketsPerS: setup.sound ? (after.soundPackets - before.soundPackets) / seconds : null,
      series: latencySeries(rows, cameras.length),
    };
  } finally {
    await live.close();
    rmSync(folder, { recursive: true, force: true });
  }
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
