/** One run of a robot with a camera in shared memory, and an operator in this process who watches it. */
import { type ChildProcess, spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { LocalStack, processFolder, type RobotSpec } from '@farpoint/local-stack';
import { SignaledOperator } from '@farpoint/robot-node/testing';
import { buildAddon } from '@farpoint/shared-memory/build';
import { cpuSecondsOfMainThread, cpuSecondsOfTree } from './cpu-time.ts';
import { type MeasuredSpan, measuredSpan, wait } from './measured-span.ts';
import { FrameColours, readFrameLog, residentPeakMb } from './robot-frames.ts';
import { type Distribution, distribution, rounded } from './stats.ts';

export const LAYOUTS = ['reference', 'farpoint'] as const;
export type Layout = (typeof LAYOUTS)[number];
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

/** @throws {Error} if the addon does not build */
export function buildSharedMemory(): void {
  const { ok, output } = buildAddon();
  if (!ok) throw new Error(`the addon does not build:\n${output}`);
}

export async function measure(layout: Layout, run: ShmRun): Promise<LayoutResult> {
  const folder = processFolder('/dev/shm');
  const [frameLog, producerLog] = [join(folder, 'frames.csv'), join(folder, 'producer.txt')];
  const { size, fps, pictures = false } = run;
  const producer = startProducer({ layout, folder, size, fps, log: producerLog, scene: pictures });
  let stack: LocalStack | null = null;
  try {
    stack = await LocalStack.start({
      robots: [robotSpec(layout, run, folder)],
      env: { FARPOINT_LOG_LEVEL: 'warn' },
    });
    const watched = await watch(stack, producer, run);
    await stack.stop();
    await stop(producer);
    return resultOf(watched, frameLog, producerLog);
  } finally {
    await stack?.stop();
    await stop(producer);
  }
}

interface ProducerOptions {
  layout: Layout;
  /** Folder of the shared memory. */
  folder: string;
  /** Points of a side. */
  size: number;
  fps: number;
  /** File in which the producer records when it began to write each frame. */
  log?: string;
  /** Whether frames have the scene's colours, and not one each. */
  scene: boolean;
}

export function startProducer({ layout, folder, size, fps, log, scene }: ProducerOptions): ChildProcess {
  return spawn(
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
      ...(log === undefined ? [] : ['--log', log]),
      ...(scene ? ['--scene'] : []),
    ],
    { stdio: ['ignore', 'inherit', 'inherit'] },
  );
}

function robotSpec(layout: Layout, run: ShmRun, folder: string): RobotSpec {
  const { fps, mbps, robotArgs = [] } = run;
  return {
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
      '--measure',
      folder,
      ...robotArgs,
    ],
  };
}

interface Watched {
  span: MeasuredSpan<'robot' | 'robotMain' | 'producer'>;
  colours: FrameColours;
  rssMbMax: number;
}

/** Connects an operator, and measures once the robot has found its pace. */
async function watch(stack: LocalStack, producer: ChildProcess, run: ShmRun): Promise<Watched> {
  const { seconds, pictures = false, onSecond, onEnd } = run;
  const robotPid = stack.robot(ROBOT).pid;
  const operator = await SignaledOperator.connect(stack.signalingUrl, ROBOT);
  const colours = new FrameColours();
  await requestCameras(operator, run);
  await wait(WARM_UP_MS);
  if (!pictures) operator.client.onCloudPacket = (payload) => colours.add(payload);
  const cpu = () => ({
    robot: cpuSecondsOfTree(robotPid),
    producer: cpuSecondsOfTree(producer.pid as number),
    robotMain: cpuSecondsOfMainThread(robotPid),
  });
  const span = await measuredSpan(cpu, async () => {
    const ticking = setInterval(() => onSecond?.(robotPid), 1000);
    await wait(seconds * 1000);
    clearInterval(ticking);
  });
  const rssMbMax = residentPeakMb(robotPid);
  await onEnd?.(stack.robotAdminUrl(ROBOT));
  operator.client.onCloudPacket = null;
  await operator.close();
  return { span, colours, rssMbMax };
}

/** Asks the robot for pictures and videos, if the run has some. */
async function requestCameras({ client }: SignaledOperator, { pictures = false, videos = 0 }: ShmRun) {
  if (pictures) {
    await client.message('cameras');
    client.sendSession({ type: 'pictures', cameras: [0] });
  }
  if (videos > 0) {
    await client.message('videos');
    client.sendSession({ type: 'videos', videos: Array.from({ length: videos }, (_, i) => i) });
  }
}

function resultOf({ span, colours, rssMbMax }: Watched, frameLog: string, producerLog: string): LayoutResult {
  const within = (ms: number) => ms >= span.beginMs && ms < span.endMs;
  const begun = readFileSync(producerLog, 'utf8').split('\n').map(Number);
  const frames = readFrameLog(frameLog).filter(({ readyMs }) => within(readyMs));
  // The reference layout carries no time. A frame is taken to be the last one begun before it was noticed.
  const latencies = frames.map(
    ({ capturedMs, readyMs }) => readyMs - (lastBefore(begun, capturedMs + 0.001) ?? Number.NaN),
  );
  return {
    latencyMs: rounded(distribution(latencies), 2),
    framesPerSecond: Number(((frames.length * 1000) / span.elapsedMs).toFixed(2)),
    framesProduced: begun.filter(within).length,
    frames: frames.length,
    torn: colours.torn,
    packetsChecked: colours.packets,
    rssMbMax,
    robotCpu: span.cores.robot,
    robotMainCpu: span.cores.robotMain,
    producerCpu: span.cores.producer,
    pointsPerFrame: Math.round(frames.reduce((sum, { points }) => sum + points, 0) / frames.length),
  };
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
