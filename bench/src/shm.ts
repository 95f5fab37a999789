/** `pnpm bench shm`: clouds through shared memory, from a producer's process to the robot's first packet. */
import { type ChildProcess, spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { LocalStack } from '@farpoint/local-stack';
import { SignaledOperator } from '@farpoint/robot-node/testing';
import { buildAddon } from '@farpoint/shared-memory/build';
import { type KillTestResult, runKillTest } from '@farpoint/shared-memory/kill-test';
import { coresBetween, cpuSecondsOfMainThread, cpuSecondsOfTree } from './cpu-time.ts';
import { type Bench, distributionCells, numberOption, printJson, printTable } from './report.ts';
import { FrameColours, readFrameLog, residentPeakMb } from './robot-frames.ts';
import { type Distribution, distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench shm [--layout both|reference|farpoint] [--size 480] [--fps 30] [--seconds 20] [--mbps 20] [--kill N [--seed 1]] [--json]

A producer process writes size × size points --fps times a second; the real robot process samples them for --mbps (10^6
bit/s) and sends them to an operator in this process. Latency: from when the producer starts to write a frame until the robot
has the frame's packets ready. Every frame has its own colour: torn counts frames that arrived with two colours.
--kill N instead kills the producer and reader processes at random until N frames have been read and checked in full.`;

const LAYOUTS = ['reference', 'farpoint'] as const;
type Layout = (typeof LAYOUTS)[number];
const WARM_UP_MS = 2000;
const ROBOT = 'shm-1';

export interface LayoutResult {
  latencyMs: Distribution;
  framesPerSecond: number;
  framesProduced: number;
  frames: number;
  torn: number;
  /** Number of packets checked for it. */
  packetsChecked: number;
  rssMbMax: number;
  robotCpu: number | null;
  /** Of that, the main thread, which drives and sends. */
  robotMainCpu: number | null;
  producerCpu: number | null;
  pointsPerFrame: number;
}

export const bench: Bench = {
  name: 'shm',
  summary: 'clouds through shared memory: latency to the first packet, torn frames, kills',
  async run(argv) {
    const { values } = parseArgs({
      args: argv,
      options: {
        layout: { type: 'string', default: 'both' },
        size: { type: 'string', default: '480' },
        fps: { type: 'string', default: '30' },
        seconds: { type: 'string', default: '20' },
        mbps: { type: 'string', default: '20' },
        kill: { type: 'string' },
        seed: { type: 'string', default: '1' },
        json: { type: 'boolean' },
        help: { type: 'boolean' },
      },
    });
    if (values.help) return console.log(USAGE);
    const layouts = LAYOUTS.filter((layout) => values.layout === 'both' || values.layout === layout);
    if (layouts.length === 0)
      throw new Error(`--layout is \`${values.layout}\`, not both, reference or farpoint`);
    const size = numberOption('size', values.size, 16);
    if (size > 480 && layouts.includes('reference'))
      throw new Error('--size: the reference layout ends at 480');
    const { ok, output } = buildAddon();
    if (!ok) throw new Error(`the addon does not build:\n${output}`);

    if (values.kill !== undefined) {
      const frames = numberOption('kill', values.kill, 1);
      const results = await killAll(layouts, frames, size * size, numberOption('seed', values.seed));
      if (values.json)
        printJson({ bench: 'shm', points: size * size, ...summedKills(results), kill: results });
      return;
    }
    const [fps, seconds] = [numberOption('fps', values.fps, 1), numberOption('seconds', values.seconds, 1)];
    const mbps = numberOption('mbps', values.mbps, 1);
    const results: Partial<Record<Layout, LayoutResult>> = {};
    for (const layout of layouts) {
      console.error(`${layout}: ${size * size} points at ${fps} frames/s for ${seconds} s`);
      results[layout] = await measure(layout, { size, fps, seconds, mbps });
    }
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
    if (!values.json) return;
    const all = rows.map(([, result]) => result);
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
  },
};

export interface ShmRun {
  size: number;
  fps: number;
  seconds: number;
  mbps: number;
  /**
   * Whether the operator also watches the camera's pictures. Clouds then have the scene's colours, and torn ones are
   * not detected. The robot's options must enable pictures.
   */
  pictures?: boolean;
  /** Number of videos that the operator watches, too. The robot's options must have as many cameras. */
  videos?: number;
  /** Called at the end, while the robot still runs. @param adminUrl of the robot */
  onEnd?: (adminUrl: string) => Promise<void>;
  /** Additional options for the robot. */
  robotArgs?: string[];
  /** Called each second. */
  onSecond?: (robotPid: number) => void;
}

export async function measure(
  layout: Layout,
  { size, fps, seconds, mbps, pictures = false, videos = 0, robotArgs = [], onSecond, onEnd }: ShmRun,
): Promise<LayoutResult> {
  const folder = mkdtempSync('/dev/shm/farpoint-bench-');
  const [frameLog, producerLog] = [join(folder, 'frames.csv'), join(folder, 'producer.txt')];
  const producer = spawn(
    process.execPath,
    [
      join(import.meta.dirname, 'shm-producer.ts'),
      '--layout',
      layout,
      '--folder',
      folder,
      '--size',
      String(size),
      '--fps',
      String(fps),
      '--log',
      producerLog,
      ...(pictures ? ['--scene'] : []),
    ],
    { stdio: ['ignore', 'inherit', 'inherit'] },
  );
  let stack: LocalStack | null = null;
  try {
    stack = await LocalStack.start({
      robots: [
        {
          id: ROBOT,
          name: 'Robot with a camera in shared memory',
          args: [
            '--source',
            'shm',
            '--shm-layout',
            layout,
            '--shm-folder',
            folder,
            '--fps',
            String(fps),
            '--rate-control',
            'fixed',
            '--plan',
            'paper',
            '--bitrate-mbps',
            String(mbps),
            '--frame-log',
            frameLog,
            ...robotArgs,
          ],
        },
      ],
      env: { FARPOINT_LOG_LEVEL: 'warn' },
    });
    const robotPid = stack.robot(ROBOT).pid;
    const operator = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
    const colours = new FrameColours();
    if (pictures) {
      await operator.client.message('cameras');
      operator.client.sendSession({ type: 'pictures', cameras: [0] });
    }
    if (videos > 0) {
      await operator.client.message('videos');
      operator.client.sendSession({ type: 'videos', videos: Array.from({ length: videos }, (_, i) => i) });
    }
    await sleep(WARM_UP_MS);
    if (!pictures) operator.client.onCloudPacket = (payload) => colours.add(payload);
    const cpu = () =>
      [
        cpuSecondsOfTree(robotPid),
        cpuSecondsOfTree(producer.pid as number),
        cpuSecondsOfMainThread(robotPid),
      ] as const;
    const [beginMs, cpuBefore] = [nowMs(), cpu()];
    const ticking = setInterval(() => onSecond?.(robotPid), 1000);
    await sleep(seconds * 1000);
    clearInterval(ticking);
    const [endMs, cpuAfter] = [nowMs(), cpu()];
    const rssMbMax = residentPeakMb(robotPid);
    await onEnd?.(stack.robotAdminUrl(ROBOT));
    operator.client.onCloudPacket = null;
    await operator.close();
    await stack.stop();
    await stop(producer);

    const within = (ms: number) => ms >= beginMs && ms < endMs;
    const begun = readFileSync(producerLog, 'utf8').split('\n').map(Number);
    const frames = readFrameLog(frameLog).filter(({ readyMs }) => within(readyMs));
    // The reference layout carries no time. A frame is taken to be the last one begun before it was noticed.
    const latencies = frames.map(
      ({ capturedMs, readyMs }) => readyMs - (lastBefore(begun, capturedMs + 0.001) ?? Number.NaN),
    );
    const elapsedMs = endMs - beginMs;
    return {
      latencyMs: rounded(distribution(latencies), 2),
      framesPerSecond: Number(((frames.length * 1000) / elapsedMs).toFixed(2)),
      framesProduced: begun.filter(within).length,
      frames: frames.length,
      torn: colours.torn,
      packetsChecked: colours.packets,
      rssMbMax,
      robotCpu: coresBetween(cpuBefore[0], cpuAfter[0], elapsedMs),
      robotMainCpu: coresBetween(cpuBefore[2], cpuAfter[2], elapsedMs),
      producerCpu: coresBetween(cpuBefore[1], cpuAfter[1], elapsedMs),
      pointsPerFrame: Math.round(frames.reduce((sum, { points }) => sum + points, 0) / frames.length),
    };
  } finally {
    await stack?.stop();
    await stop(producer);
    rmSync(folder, { recursive: true, force: true });
  }
}

async function killAll(
  layouts: readonly Layout[],
  frames: number,
  points: number,
  seed: number,
): Promise<Partial<Record<Layout, KillTestResult>>> {
  const results: Partial<Record<Layout, KillTestResult>> = {};
  for (const layout of layouts) {
    const folder = mkdtempSync('/dev/shm/farpoint-bench-');
    console.error(`${layout}: ${frames} frames of ${points} points, both sides killed at random`);
    try {
      results[layout] = await runKillTest({
        layout,
        folder,
        frames,
        points,
        leastKills: 10,
        seed,
        lifeMs: [20, 1500],
      });
    } finally {
      rmSync(folder, { recursive: true, force: true });
    }
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

/** The last of the ascending times that is not after `limit`. */
function lastBefore(times: readonly number[], limit: number): number | undefined {
  let [low, high] = [0, times.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((times[middle] as number) <= limit) low = middle + 1;
    else high = middle;
  }
  return times[low - 1];
}

async function stop(child: ChildProcess): Promise<void> {
  if (child.exitCode !== null || child.signalCode !== null) return;
  const ended = new Promise((resolve) => child.once('exit', resolve));
  child.kill('SIGTERM');
  await ended;
}

function nowMs(): number {
  return Number(process.hrtime.bigint()) / 1e6;
}

function sleep(ms: number): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, ms));
}
