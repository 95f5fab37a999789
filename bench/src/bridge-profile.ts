/**
 * `pnpm bench bridge --profile`: measures where the time of a small frame goes, from a camera's shared memory to a
 * page's socket.
 */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { BridgeProcess, LocalStack, processFolder, type RobotSpec } from '@farpoint/local-stack';
import { buildAddon } from '@farpoint/shared-memory/build';
import { buildAddon as buildUdpBatch } from '@farpoint/udp-batch/build';
import { PageReader, readBridgeFrames } from './bridge-page.ts';
import { cpuSecondsOfTree } from './cpu-time.ts';
import { type MeasuredSpan, measuredSpan, wait } from './measured-span.ts';
import { distributionCells, printJson, printTable } from './report.ts';
import { readFrameLog } from './robot-frames.ts';
import { startProducer } from './shm-run.ts';
import { type Distribution, distribution, rounded } from './stats.ts';

const WARM_UP_MS = 8000;
const ROBOT = 'shm-1';

export interface ProfileOptions {
  points: number;
  fps: number;
  seconds: number;
  json: boolean;
}

/** When one frame reached each stage, ms on the machine's clock. */
interface FrameTimes {
  captured: number;
  ready: number;
  firstSent: number;
  lastSent: number;
  lastReceived: number;
  emitted: number;
  read: number;
}

const STAGES: readonly [name: string, from: keyof FrameTimes, to: keyof FrameTimes][] = [
  ['producer writes, robot samples and packs', 'captured', 'ready'],
  ['robot waits for the frame’s turn', 'ready', 'firstSent'],
  ['robot sends, first packet to last', 'firstSent', 'lastSent'],
  ['socket to bridge', 'lastSent', 'lastReceived'],
  ['bridge puts together and hands over', 'lastReceived', 'emitted'],
  ['socket to page', 'emitted', 'read'],
  ['in all', 'captured', 'read'],
];

interface LogFiles {
  packetLog: string;
  frameLog: string;
  /** The bridge writes it. */
  stats: string;
}

/** Rate control and plan are the robot's defaults: it does not know how much the path carries. */
export async function profile(options: ProfileOptions): Promise<void> {
  buildAddon();
  buildUdpBatch();
  const folder = processFolder('/dev/shm');
  const files: LogFiles = {
    packetLog: join(folder, 'packets.csv'),
    frameLog: join(folder, 'frames.csv'),
    stats: join(folder, 'bridge-frames.jsonl'),
  };
  // As many points as are sent: the reference system's producer has already sampled them, too.
  const size = Math.ceil(Math.sqrt(options.points) / 4) * 4;
  const producer = startProducer({ layout: 'farpoint', folder, size, fps: options.fps, scene: true });
  const env = { FARPOINT_LOG_LEVEL: 'warn' };
  let stack: LocalStack | null = null;
  let bridge: BridgeProcess | null = null;
  let reader: PageReader | null = null;
  try {
    stack = await LocalStack.start({ env, robots: [robotSpec(options, folder)] });
    bridge = await BridgeProcess.start(stack, { env, args: ['--stats', files.stats] });
    reader = new PageReader(bridge);
    await reader.connected();
    await wait(WARM_UP_MS);
    const [robotPid, bridgePid] = [stack.robot(ROBOT).pid, bridge.process.pid];
    const cpu = () => ({ robot: cpuSecondsOfTree(robotPid), bridge: cpuSecondsOfTree(bridgePid) });
    const span = await measuredSpan(cpu, () => wait(options.seconds * 1000));
    const read = await reader.end();
    await bridge.stop();
    await stack.robot(ROBOT).stop();
    const frames = joined(files, read).filter(
      ({ captured }) => captured >= span.beginMs && captured < span.endMs,
    );
    report(options, frames, span);
  } finally {
    reader?.kill();
    await bridge?.stop();
    await stack?.stop();
    producer.kill('SIGTERM');
  }
}

function robotSpec({ points, fps }: ProfileOptions, folder: string): RobotSpec {
  return {
    id: ROBOT,
    name: 'Robot with a camera in shared memory',
    reference: true,
    args: [
      '--source',
      'shm',
      '--shm-layout',
      'farpoint',
      '--shm-folder',
      folder,
      '--fps',
      String(fps),
      '--max-points',
      String(points),
      '--measure',
      folder,
    ],
  };
}

function report(
  { points, fps, seconds, json }: ProfileOptions,
  frames: readonly FrameTimes[],
  { cores }: MeasuredSpan<'robot' | 'bridge'>,
): void {
  const stages = STAGES.map(([name, from, to]): [string, Distribution] => [
    name,
    rounded(distribution(frames.map((frame) => frame[to] - frame[from])), 2),
  ]);
  printTable(
    ['stage, ms', 'p50', 'p95', 'p99', 'max'],
    stages.map(([name, times]) => [name, ...distributionCells(times)]),
  );
  const { robot: robotCpu, bridge: bridgeCpu } = cores;
  printTable(
    ['points', 'frames/s', 'frames', 'robot, cores', 'bridge, cores'],
    [[points, (frames.length / seconds).toFixed(1), frames.length, robotCpu, bridgeCpu]],
  );
  if (json) {
    const byStage = Object.fromEntries(stages);
    printJson({ bench: 'bridge-profile', points, fps, seconds, stages: byStage, robotCpu, bridgeCpu });
  }
}

/** Joins the robot's frames, its packets, the bridge's frames and the reader's messages, each in order. */
function joined({ frameLog, packetLog, stats }: LogFiles, read: readonly { atMs: number }[]): FrameTimes[] {
  const captured = readFrameLog(frameLog);
  const sent = new Map<number, { first: number; last: number }>();
  for (const line of readFileSync(packetLog, 'utf8').trimEnd().split('\n').slice(1)) {
    const [frame, , atMs] = line.split(',').map(Number) as [number, number, number];
    const times = sent.get(frame);
    if (times === undefined) sent.set(frame, { first: atMs, last: atMs });
    else times.last = atMs;
  }
  const emitted = readBridgeFrames(stats).filter(({ pages }) => pages > 0);
  const frames: FrameTimes[] = [];
  let at = 0;
  emitted.forEach(({ frameNumber, lastPacketMs, emittedMs, points, expectedPoints }, n) => {
    const packets = sent.get(frameNumber);
    const arrival = read[n];
    if (packets === undefined || arrival === undefined || points < expectedPoints) return;
    // Frame numbers restart with each connection, so the frame that was ready last is the one sent.
    while ((captured[at + 1]?.readyMs ?? Number.POSITIVE_INFINITY) <= packets.first) at++;
    const frame = captured[at];
    if (frame === undefined || frame.readyMs > packets.first) return;
    frames.push({
      captured: frame.capturedMs,
      ready: frame.readyMs,
      firstSent: packets.first,
      lastSent: packets.last,
      lastReceived: lastPacketMs,
      emitted: emittedMs,
      read: arrival.atMs,
    });
  });
  return frames;
}
