/** `pnpm bench bridge`: the robot in the reference profile, through the bridge, to a page's streaming socket. */

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { BridgeProcess, LocalStack, processFolder, type RobotSpec } from '@farpoint/local-stack';
import { bytesOfPoints, MAX_POINT_DATA_BYTES, POINTS_PER_PACKET, packetCountOf } from '@farpoint/protocol';
import { BitRate } from '@farpoint/timing';
import { benchOptions, option } from './bench-options.ts';
import { type Arrival, type BridgeFrame, PageReader, readBridgeFrames } from './bridge-page.ts';
import { profile } from './bridge-profile.ts';
import { cpuSecondsOfTree } from './cpu-time.ts';
import { type MeasuredSpan, measuredSpan, wait } from './measured-span.ts';
import { readPacketLog, type SentTimes } from './packet-log.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import { type Distribution, distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench bridge [--points 100000] [--fps 10] [--seconds 60] [--mbps 100] [--json]
       pnpm bench bridge --profile [--points 7500] [--fps 18] [--seconds 30] [--json]

Real robot (simulated office) in the reference profile, signaling, bridge, and a reader of the streaming socket, each in its
own process, without a network between them. Two runs of --seconds each: --points at --fps (rounded up to whole packets),
then as many points at --fps as --mbps (10^6 bit/s on the wire, including headers) carries; --mbps 0 skips the second run.

emitMs: from the arrival of a frame's last packet in the bridge to the complete message in the reader; handOverMs is the part
until the bridge has handed it to the socket. sendToReadMs: from the robot's send call of that packet to the reader. Incomplete
frames count in neither; see framesPartial.

--profile takes clouds from a camera's shared memory instead, with the robot's own rate control, and prints the time of each
stage of a frame, up to the complete message in the reader.`;

const WARM_UP_MS = 6000;
/** On the wire: IP 20, UDP 8, RTP 12, extension 8, payload 1216, SRTP tag 16. */
const WIRE_BYTES_PER_PACKET = 1280;
const RSS_EVERY_MS = 250;

interface RunResult {
  mbps: number;
  seconds: number;
  pointsPerFrame: number;
  framesPerSecond: number;
  emitMs: Distribution;
  handOverMs: Distribution;
  sendToReadMs: Distribution;
  frames: number;
  framesPartial: number;
  framesUnsent: number;
  lossRate: number;
  robotCpu: number | null;
  bridgeCpu: number | null;
  robotCpuPerMbps: number | null;
  bridgeCpuPerMbps: number | null;
  bridgeRssMbStart: number;
  bridgeRssMbMax: number;
  bridgeRssMbEnd: number;
}

/** The usual stream, and that of `--profile`. */
const STREAMED = { points: 100_000, fps: 10, seconds: 60 };
const PROFILED = { points: 7500, fps: 18, seconds: 30 };

const OPTIONS = {
  points: option.number(undefined, { least: POINTS_PER_PACKET }),
  fps: option.number(undefined, { least: 1 }),
  seconds: option.number(undefined, { least: 1 }),
  /** Rate of the second run; 0 without one. */
  mbps: option.number(100),
  profile: option.flag,
};

export const bench: Bench = {
  name: 'bridge',
  summary: 'the reference profile through the bridge to a page’s streaming socket',
  usage: USAGE,
  async run(argv) {
    const { mbps, profile: isProfile, json, ...given } = benchOptions(argv, OPTIONS);
    const usual = isProfile ? PROFILED : STREAMED;
    const { points = usual.points, fps = usual.fps, seconds = usual.seconds } = given;
    if (isProfile) return profile({ points, fps, seconds, json });
    const first = await run({ packets: packetCountOf(points), fps, seconds });
    const packets = Math.floor(
      BitRate.toBytesPerSecond(BitRate.fromMbps(mbps)) / WIRE_BYTES_PER_PACKET / fps,
    );
    const sustained = packets === 0 ? null : await run({ packets, fps, seconds });
    const runs = sustained === null ? [first] : [first, sustained];
    print(runs);
    if (json) {
      const bridgeRssMbMax = Math.max(...runs.map((r) => r.bridgeRssMbMax));
      printJson({ bench: 'bridge', ...first, bridgeRssMbMax, sustained });
    }
  },
};

function print(runs: readonly RunResult[]): void {
  printTable(
    ['', 'p50', 'p95', 'p99', 'max'],
    runs.flatMap((r) => [
      [`emit at ${r.mbps} Mbit/s, ms`, ...distributionCells(r.emitMs)],
      [`send to read at ${r.mbps} Mbit/s, ms`, ...distributionCells(r.sendToReadMs)],
    ]),
  );
  printTable(
    ['wire Mbit/s', 'frames/s', 'points', 'loss', 'partial', 'robot, cores', 'bridge, cores', 'RSS max, MB'],
    runs.map((r) => [
      r.mbps,
      r.framesPerSecond,
      r.pointsPerFrame,
      r.lossRate,
      r.framesPartial,
      r.robotCpu,
      r.bridgeCpu,
      r.bridgeRssMbMax,
    ]),
  );
}

/** The stream that the robot sends. */
interface Load {
  /** Packets of each frame. */
  packets: number;
  fps: number;
  seconds: number;
}

async function run(load: Load): Promise<RunResult> {
  const folder = processFolder();
  const [sentFile, frameFile] = [join(folder, 'packets.csv'), join(folder, 'frames.jsonl')];
  const env = { FARPOINT_LOG_LEVEL: 'warn' };
  const { packets, fps, seconds } = load;
  const mbps = BitRate.toMbps(BitRate.fromBytesPerSecond(packets * WIRE_BYTES_PER_PACKET * fps));
  console.error(`${packets * POINTS_PER_PACKET} points at ${fps} frames/s: ${mbps.toFixed(1)} Mbit/s`);
  const stack = await LocalStack.start({ robots: [], env });
  let bridge: BridgeProcess | null = null;
  let reader: PageReader | null = null;
  try {
    await stack.startRobot(robotSpec(load, mbps, folder));
    bridge = await BridgeProcess.start(stack, {
      env,
      args: ['--stats', frameFile, '--start-bits-per-second', '200e6', '--max-bits-per-second', '200e6'],
    });
    reader = new PageReader(bridge);
    await reader.connected();
    await wait(WARM_UP_MS);
    const use = await useDuring(stack.robot('sim-1').pid, bridge.process.pid, seconds);
    const read = await reader.end();
    await bridge.stop();
    await stack.robot('sim-1').stop();
    const { beginMs, endMs } = use.span;
    const times = join3(readBridgeFrames(frameFile), read, readPacketLog(sentFile), beginMs, endMs);
    return resultOf(times, use);
  } finally {
    reader?.kill();
    await bridge?.stop();
    await stack.stop();
  }
}

function robotSpec({ packets, fps }: Load, mbps: number, folder: string): RobotSpec {
  return {
    id: 'sim-1',
    name: 'Simulated robot',
    reference: true,
    args: [
      '--fps',
      String(fps),
      '--measure',
      folder,
      '--max-points',
      String(packets * POINTS_PER_PACKET),
      // Slightly more than the frames need, so that pacing leaves a pause before the next frame.
      '--rate-control',
      'fixed',
      '--plan',
      'paper',
      '--bitrate-mbps',
      (mbps * 1.05).toFixed(2),
    ],
  };
}

/** Processor time and memory that the programs used. */
interface Use {
  span: MeasuredSpan<'robot' | 'bridge'>;
  /** Memory of the bridge, each 250 ms, MB. */
  rssMb: number[];
}

async function useDuring(robotPid: number, bridgePid: number, seconds: number): Promise<Use> {
  const cpu = () => ({ robot: cpuSecondsOfTree(robotPid), bridge: cpuSecondsOfTree(bridgePid) });
  const rss: number[] = [rssMb(bridgePid)];
  const memory = setInterval(() => rss.push(rssMb(bridgePid)), RSS_EVERY_MS);
  try {
    return { span: await measuredSpan(cpu, () => wait(seconds * 1000)), rssMb: rss };
  } finally {
    clearInterval(memory);
  }
}

function resultOf(times: Joined, { span, rssMb }: Use): RunResult {
  const received = times.points / POINTS_PER_PACKET;
  const wireMbps = BitRate.toMbps(BitRate.of(received * WIRE_BYTES_PER_PACKET, span.elapsedMs));
  const { robot: robotCpu, bridge: bridgeCpu } = span.cores;
  const perMbps = (cores: number | null) => (cores === null ? null : Number((cores / wireMbps).toFixed(5)));
  return {
    mbps: Number(wireMbps.toFixed(2)),
    seconds: Number((span.elapsedMs / 1000).toFixed(2)),
    pointsPerFrame: Math.round(times.points / times.frames),
    framesPerSecond: Number(((times.frames * 1000) / span.elapsedMs).toFixed(2)),
    emitMs: rounded(distribution(times.emitMs), 2),
    handOverMs: rounded(distribution(times.handOverMs), 2),
    sendToReadMs: rounded(distribution(times.sendToReadMs), 2),
    frames: times.frames,
    framesPartial: times.partial,
    framesUnsent: times.unsent,
    lossRate: Number((1 - times.points / times.expectedPoints).toFixed(6)),
    robotCpu,
    bridgeCpu,
    robotCpuPerMbps: perMbps(robotCpu),
    bridgeCpuPerMbps: perMbps(bridgeCpu),
    bridgeRssMbStart: rssMb[0] as number,
    bridgeRssMbMax: Math.max(...rssMb),
    bridgeRssMbEnd: rssMb.at(-1) as number,
  };
}

interface Joined {
  emitMs: number[];
  handOverMs: number[];
  sendToReadMs: number[];
  frames: number;
  partial: number;
  unsent: number;
  points: number;
  expectedPoints: number;
}

/**
 * Joins the bridge's frames, the reader's messages (one for each frame sent to a page, in order) and the robot's
 * packets.
 */
function join3(
  records: readonly BridgeFrame[],
  read: readonly Arrival[],
  sent: SentTimes,
  fromMs: number,
  toMs: number,
): Joined {
  const joined: Joined = {
    emitMs: [],
    handOverMs: [],
    sendToReadMs: [],
    frames: 0,
    partial: 0,
    unsent: 0,
    points: 0,
    expectedPoints: 0,
  };
  const delivered = records.filter(({ pages }) => pages > 0);
  // Frames before the reader connected reached nobody.
  const arrivalOf = new Map(delivered.map((record, i) => [record, read[i]]));
  for (const record of records) {
    if (record.lastPacketMs < fromMs || record.lastPacketMs >= toMs) continue;
    joined.frames++;
    joined.points += record.points;
    joined.expectedPoints += record.expectedPoints;
    if (record.pages === 0) joined.unsent++;
    const arrival = arrivalOf.get(record);
    if (record.points < record.expectedPoints) {
      joined.partial++;
      continue;
    }
    if (arrival === undefined) continue;
    if (arrival.bytes !== bytesOfPoints(record.points))
      throw new Error('the reader’s messages are not the bridge’s frames');
    joined.emitMs.push(arrival.atMs - record.lastPacketMs);
    joined.handOverMs.push(record.emittedMs - record.lastPacketMs);
    const lastPacketOffset = bytesOfPoints(record.expectedPoints) - MAX_POINT_DATA_BYTES;
    const sentMs = sent.get(`${record.frameNumber}:${lastPacketOffset}`);
    if (sentMs !== undefined) joined.sendToReadMs.push(arrival.atMs - sentMs);
  }
  return joined;
}

function rssMb(pid: number): number {
  const pages = Number(readFileSync(`/proc/${pid}/statm`, 'utf8').split(' ')[1]);
  return Number(((pages * 4096) / 1e6).toFixed(1));
}
