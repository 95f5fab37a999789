/**
 * `pnpm bench bridge --profile`: measures where the time of a small frame goes, from a camera's shared memory to a
 * page's socket.
 */
import { type ChildProcess, fork, spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { BridgeProcess, LocalStack } from '@farpoint/local-stack';
import { buildAddon } from '@farpoint/shared-memory/build';
import { buildAddon as buildUdpBatch } from '@farpoint/udp-batch/build';
import { coresBetween, cpuSecondsOfTree } from './cpu-time.ts';
import { distributionCells, printJson, printTable } from './report.ts';
import { readFrameLog } from './robot-frames.ts';
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

/** Rate control and plan are the robot's defaults: it does not know how much the path carries. */
export async function profile({ points, fps, seconds, json }: ProfileOptions): Promise<void> {
  buildAddon();
  buildUdpBatch();
  const folder = mkdtempSync('/dev/shm/farpoint-profile-');
  const [packetLog, frameLog, stats] = ['packets.csv', 'frames.csv', 'frames.jsonl'].map((name) =>
    join(folder, name),
  ) as [string, string, string];
  const producer = spawn(
    process.execPath,
    [
      join(import.meta.dirname, 'shm-producer.ts'),
      '--layout',
      'farpoint',
      '--folder',
      folder,
      // As many points as are sent: the reference system's producer has already sampled them, too.
      '--fps',
      String(fps),
      '--size',
      String(Math.ceil(Math.sqrt(points) / 4) * 4),
      '--scene',
    ],
    { stdio: ['ignore', 'inherit', 'inherit'] },
  );
  const env = { FARPOINT_LOG_LEVEL: 'warn' };
  let stack: LocalStack | null = null;
  let bridge: BridgeProcess | null = null;
  let reader: ChildProcess | null = null;
  try {
    stack = await LocalStack.start({
      env,
      robots: [
        {
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
            '--packet-log',
            packetLog,
            '--frame-log',
            frameLog,
          ],
        },
      ],
    });
    bridge = await BridgeProcess.start(stack, { env, args: ['--stats', stats] });
    reader = fork(new URL('./bridge-reader.ts', import.meta.url), [String(bridge.ports.streaming)], {
      detached: true,
    });
    await nextMessage(reader);
    await wait(WARM_UP_MS);
    const [robotPid, bridgePid] = [stack.robot(ROBOT).pid, bridge.process.pid];
    const cpu = () => ({ robot: cpuSecondsOfTree(robotPid), bridge: cpuSecondsOfTree(bridgePid) });
    const [fromMs, before] = [nowMs(), cpu()];
    await wait(seconds * 1000);
    const [toMs, after] = [nowMs(), cpu()];
    const arrivals = nextMessage<{ arrivals: { atMs: number }[] }>(reader);
    reader.send('end');
    const read = (await arrivals).arrivals;
    await bridge.stop();
    await stack.robot(ROBOT).stop();
    const frames = joined(readFrameLog(frameLog), packetLog, stats, read).filter(
      ({ captured }) => captured >= fromMs && captured < toMs,
    );
    const stages = STAGES.map(([name, from, to]): [string, Distribution] => [
      name,
      rounded(distribution(frames.map((frame) => frame[to] - frame[from])), 2),
    ]);
    printTable(
      ['stage, ms', 'p50', 'p95', 'p99', 'max'],
      stages.map(([name, times]) => [name, ...distributionCells(times)]),
    );
    const robotCpu = coresBetween(before.robot, after.robot, toMs - fromMs);
    const bridgeCpu = coresBetween(before.bridge, after.bridge, toMs - fromMs);
    printTable(
      ['points', 'frames/s', 'frames', 'robot, cores', 'bridge, cores'],
      [[points, (frames.length / seconds).toFixed(1), frames.length, robotCpu, bridgeCpu]],
    );
    if (json) {
      const byStage = Object.fromEntries(stages);
      printJson({ bench: 'bridge-profile', points, fps, seconds, stages: byStage, robotCpu, bridgeCpu });
    }
  } finally {
    reader?.kill();
    await bridge?.stop();
    await stack?.stop();
    producer.kill('SIGTERM');
    rmSync(folder, { recursive: true, force: true });
  }
}

/** Joins the robot's frames, its packets, the bridge's frames and the reader's messages, each in order. */
function joined(
  captured: ReturnType<typeof readFrameLog>,
  packetLog: string,
  stats: string,
  read: readonly { atMs: number }[],
): FrameTimes[] {
  const sent = new Map<number, { first: number; last: number }>();
  for (const line of readFileSync(packetLog, 'utf8').trimEnd().split('\n').slice(1)) {
    const [frame, , atMs] = line.split(',').map(Number) as [number, number, number];
    const times = sent.get(frame);
    if (times === undefined) sent.set(frame, { first: atMs, last: atMs });
    else times.last = atMs;
  }
  const emitted = readFileSync(stats, 'utf8')
    .trimEnd()
    .split('\n')
    .map((line) => JSON.parse(line) as BridgeFrame)
    .filter(({ pages }) => pages > 0);
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

/** A line of the bridge's `--stats`. */
export interface BridgeFrame {
  frameNumber: number;
  points: number;
  expectedPoints: number;
  lastPacketMs: number;
  emittedMs: number;
  pages: number;
}

export function nowMs(): number {
  const [seconds, nanoseconds] = process.hrtime();
  return seconds * 1000 + nanoseconds / 1e6;
}

export function nextMessage<T>(child: ChildProcess): Promise<T> {
  return new Promise((resolve, reject) => {
    child.once('message', (message) => resolve(message as T));
    child.once('exit', (code) => reject(new Error(`the reader ended with code ${code}`)));
  });
}

export function wait(ms: number): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, ms));
}
