/** `pnpm bench transport`: the point stream from the robot process to the browser's worker, at a fixed rate. */

import { join } from 'node:path';
import { processFolder } from '@farpoint/local-stack';
import { MAX_POINT_DATA_BYTES } from '@farpoint/protocol';
import { BitRate } from '@farpoint/timing';
import { benchOptions, type OptionValues, option } from './bench-options.ts';
import { coresBetween, cpuSecondsOfTree } from './cpu-time.ts';
import { type LiveStack, startLiveStack } from './live-stack.ts';
import { deliveryTimes, readPacketLog } from './packet-log.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import { distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench transport [--mbps 40] [--seconds 20] [--fps 30] [--canvas 64x36] [--json]

Real robot (simulated office, points64), signaling and headless Chromium, without a network between them. The robot fills
--mbps (10^6 bit/s on the wire, including headers). Delivery is measured for each packet, from the socket's send call to the
browser's worker; the session's own clock probes align the robot's and the browser's clocks. The canvas is tiny so that the
stream is measured, not the drawing.`;

const WARM_UP_MS = 2000;
/** Bytes per packet in addition to the payload: RTP header 12, extensions 12, SRTP tag 16, UDP 8, IPv4 20. */
const WIRE_OVERHEAD_BYTES = 68;

const OPTIONS = {
  mbps: option.number(40, { least: 1 }),
  seconds: option.number(20, { least: 1 }),
  fps: option.number(30, { least: 1 }),
  canvas: option.text('64x36'),
};
type Options = OptionValues<typeof OPTIONS>;

export const bench: Bench = {
  name: 'transport',
  summary: 'point stream from the robot process to the browser’s worker at one rate',
  usage: USAGE,
  async run(argv) {
    const options = benchOptions(argv, OPTIONS);
    const folder = processFolder();
    const logFile = join(folder, 'packets.csv');
    const live = await startLiveStack({
      robot: { id: 'sim-1', name: 'Simulated robot', args: robotArgs(options, folder) },
      canvas: options.canvas,
      log: (line) => console.error(line),
    });
    try {
      const record = await receive(live, options);
      await live.stack.robot('sim-1').stop();
      const result = figuresOf(options, record, logFile);
      print(result);
      if (options.json) printJson(result);
    } finally {
      await live.close();
    }
  },
};

function robotArgs({ fps, mbps }: Options, folder: string): string[] {
  return [
    '--mode',
    'points64',
    '--fps',
    String(fps),
    '--measure',
    folder,
    '--rate-control',
    'fixed',
    '--plan',
    'paper',
    '--bitrate-mbps',
    String(mbps),
  ];
}

type PageStats = ReturnType<Window['farpoint']['stats']>;

interface Received {
  /** The page's statistics at the beginning and the end, with its clock, ms. */
  before: PageStats & { nowMs: number };
  after: PageStats & { nowMs: number };
  elapsedMs: number;
  robotCpu: number | null;
  browserCpu: number | null;
  packets: ReturnType<Window['farpoint']['recordedPackets']>;
}

async function receive(
  { page, stack, browserPid }: LiveStack,
  { mbps, seconds }: Options,
): Promise<Received> {
  await page.waitForTimeout(WARM_UP_MS);
  const robotPid = stack.robot('sim-1').pid;
  const cpu = () => ({ robot: cpuSecondsOfTree(robotPid), browser: cpuSecondsOfTree(browserPid) });
  console.error(`${seconds} s at ${mbps} Mbit/s`);
  const capacity = Math.ceil(
    (BitRate.toBytesPerSecond(BitRate.fromMbps(mbps)) / MAX_POINT_DATA_BYTES) * seconds * 1.2,
  );
  const before = await page.evaluate((capacity) => {
    window.farpoint.recordPackets(capacity);
    return { nowMs: performance.now(), ...window.farpoint.stats() };
  }, capacity);
  const cpuBefore = cpu();
  await page.waitForTimeout(seconds * 1000);
  const after = await page.evaluate(() => ({ nowMs: performance.now(), ...window.farpoint.stats() }));
  const cpuAfter = cpu();
  const packets = await page.evaluate(() => window.farpoint.recordedPackets());
  const elapsedMs = after.nowMs - before.nowMs;
  return {
    before,
    after,
    elapsedMs,
    robotCpu: coresBetween(cpuBefore.robot, cpuAfter.robot, elapsedMs),
    browserCpu: coresBetween(cpuBefore.browser, cpuAfter.browser, elapsedMs),
    packets,
  };
}

type Figures = ReturnType<typeof figuresOf>;

/** @returns the object that `--json` prints */
function figuresOf({ mbps, canvas }: Options, record: Received, packetLog: string) {
  const { before, after, elapsedMs, packets } = record;
  const received = after.packetsReceived - before.packetsReceived;
  const lost = after.packetsLost - before.packetsLost;
  const payloadMbps = BitRate.toMbps(BitRate.of(after.bytesReceived - before.bytesReceived, elapsedMs));
  const wireMbps = payloadMbps + BitRate.toMbps(BitRate.of(received * WIRE_OVERHEAD_BYTES, elapsedMs));
  return {
    bench: 'transport',
    mbps: Number(wireMbps.toFixed(2)),
    payloadMbps: Number(payloadMbps.toFixed(2)),
    targetMbps: mbps,
    seconds: Number((elapsedMs / 1000).toFixed(2)),
    packetsReceived: received,
    packetsLost: lost,
    lossRate: received + lost === 0 ? 1 : Math.max(0, lost) / (received + lost),
    deliveryMs: rounded(distribution(deliveryTimes(readPacketLog(packetLog), packets.values)), 2),
    clockErrorMs: packets.minRttMs === null ? null : packets.minRttMs / 2,
    robotCpu: record.robotCpu,
    browserCpu: record.browserCpu,
    framesPerSecond: Number(after.framesPerSecond.toFixed(1)),
    pointsPerFrame: Math.round(after.pointsPerFrame),
    canvas,
  };
}

function print(result: Figures): void {
  printTable(['', 'p50', 'p95', 'p99', 'max'], [['delivery, ms', ...distributionCells(result.deliveryMs)]]);
  printTable(
    ['wire Mbit/s', 'packets', 'lost', 'robot, cores', 'browser, cores'],
    [[result.mbps, result.packetsReceived, result.packetsLost, result.robotCpu, result.browserCpu]],
  );
}
