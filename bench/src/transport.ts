/** `pnpm bench transport`: the point stream from the robot process to the browser's worker, at a fixed rate. */

import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { MAX_POINT_DATA_BYTES } from '@farpoint/protocol';
import { BitRate } from '@farpoint/timing';
import { coresBetween, cpuSecondsOfTree } from './cpu-time.ts';
import { startLiveStack } from './live-stack.ts';
import { deliveryTimes, readPacketLog } from './packet-log.ts';
import { type Bench, distributionCells, numberOption, printJson, printTable } from './report.ts';
import { distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench transport [--mbps 40] [--seconds 20] [--fps 30] [--canvas 64x36] [--json]

Real robot (simulated office, points64), signaling and headless Chromium, without a network between them. The robot fills
--mbps (10^6 bit/s on the wire, including headers). Delivery is measured for each packet, from the socket's send call to the
browser's worker; the session's own clock probes align the robot's and the browser's clocks. The canvas is tiny so that the
stream is measured, not the drawing.`;

const WARM_UP_MS = 2000;
/** Bytes per packet in addition to the payload: RTP header 12, extensions 12, SRTP tag 16, UDP 8, IPv4 20. */
const WIRE_OVERHEAD_BYTES = 68;

export const bench: Bench = {
  name: 'transport',
  summary: 'point stream from the robot process to the browser’s worker at one rate',
  async run(argv) {
    const { values } = parseArgs({
      args: argv,
      options: {
        mbps: { type: 'string', default: '40' },
        seconds: { type: 'string', default: '20' },
        fps: { type: 'string', default: '30' },
        canvas: { type: 'string', default: '64x36' },
        json: { type: 'boolean' },
        help: { type: 'boolean' },
      },
    });
    if (values.help) return console.log(USAGE);
    const mbps = numberOption('mbps', values.mbps, 1);
    const seconds = numberOption('seconds', values.seconds, 1);
    const fps = numberOption('fps', values.fps, 1);

    const folder = mkdtempSync(join(tmpdir(), 'farpoint-transport-'));
    const logFile = join(folder, 'sent.csv');
    const live = await startLiveStack({
      robot: {
        id: 'sim-1',
        name: 'Simulated robot',
        args: [
          '--mode',
          'points64',
          '--fps',
          String(fps),
          '--packet-log',
          logFile,
          '--rate-control',
          'fixed',
          '--plan',
          'paper',
          '--bitrate-mbps',
          String(mbps),
        ],
      },
      canvas: values.canvas,
      log: (line) => console.error(line),
    });
    try {
      const { page, stack, browserPid } = live;
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
      const record = await page.evaluate(() => window.farpoint.recordedPackets());
      await stack.robot('sim-1').stop();

      const elapsedMs = after.nowMs - before.nowMs;
      const received = after.packetsReceived - before.packetsReceived;
      const lost = after.packetsLost - before.packetsLost;
      const payloadMbps = BitRate.toMbps(BitRate.of(after.bytesReceived - before.bytesReceived, elapsedMs));
      const wireMbps = payloadMbps + BitRate.toMbps(BitRate.of(received * WIRE_OVERHEAD_BYTES, elapsedMs));
      const deliveryMs = rounded(distribution(deliveryTimes(readPacketLog(logFile), record.values)), 2);
      const result = {
        bench: 'transport',
        mbps: Number(wireMbps.toFixed(2)),
        payloadMbps: Number(payloadMbps.toFixed(2)),
        targetMbps: mbps,
        seconds: Number((elapsedMs / 1000).toFixed(2)),
        packetsReceived: received,
        packetsLost: lost,
        lossRate: received + lost === 0 ? 1 : Math.max(0, lost) / (received + lost),
        deliveryMs,
        clockErrorMs: record.minRttMs === null ? null : record.minRttMs / 2,
        robotCpu: coresBetween(cpuBefore.robot, cpuAfter.robot, elapsedMs),
        browserCpu: coresBetween(cpuBefore.browser, cpuAfter.browser, elapsedMs),
        framesPerSecond: Number(after.framesPerSecond.toFixed(1)),
        pointsPerFrame: Math.round(after.pointsPerFrame),
        canvas: values.canvas,
      };
      printTable(['', 'p50', 'p95', 'p99', 'max'], [['delivery, ms', ...distributionCells(deliveryMs)]]);
      printTable(
        ['wire Mbit/s', 'packets', 'lost', 'robot, cores', 'browser, cores'],
        [[result.mbps, received, lost, result.robotCpu, result.browserCpu]],
      );
      if (values.json) printJson(result);
    } finally {
      await live.close();
      rmSync(folder, { recursive: true, force: true });
    }
  },
};
