/** `pnpm bench link`: the real robot and the real browser over an emulated link. */

import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { BitRate } from '@farpoint/timing';
import { coresBetween, cpuSecondsOfTree } from './cpu-time.ts';
import {
  capacityRises,
  describeOutages,
  grown,
  isWithin,
  longestQueueAbove,
  outagesOf,
  queueQuantiles,
  shareOf,
  utilisationOf,
  worst,
} from './link-analysis.ts';
import { readLinkOptions } from './link-options.ts';
import { downlinkOutages, traceOutages } from './link-outages.ts';
import { plotLink } from './link-plot.ts';
import {
  drivePage,
  type LatencyParts,
  monotonicMs,
  readRobotSamples,
  readUplink,
  scrape,
} from './link-run.ts';
import { startLiveStack } from './live-stack.ts';
import { type Bench, distributionCells, printJson, printTable } from './report.ts';
import { sensorRows } from './sensor-rows.ts';
import { distribution, rounded } from './stats.ts';

/** Excluded from the start of the link on, because the rate is still being found. */
const WARM_UP_MS = 5000;
const DOWNLINK_MBPS = 50;
/** Capacity before a trace begins. */
const CONNECT_MBPS = 10;
/** A latency test in progress when the service ends or begins says nothing about the link in service. */
const MARGIN_MS = 500;

export const bench: Bench = {
  name: 'link',
  summary: 'the whole stack over an emulated link: utilisation, latency, recovery',
  async run(argv) {
    const options = readLinkOptions(argv);
    if (options === null) return;
    const { values, rateMbps, seconds, drawEvery, robots, fps, sensors } = options;

    const folder = values.keep ?? mkdtempSync(join(tmpdir(), 'farpoint-link-'));
    const linkFile = join(folder, 'link.jsonl');
    const robotFiles = Array.from({ length: robots }, (_, i) => join(folder, `robot-${i + 1}.jsonl`));
    const robot = (i: number) => ({
      id: `sim-${i + 1}`,
      name: `Simulated robot ${i + 1}`,
      args: [
        '--fps',
        String(fps),
        '--plan',
        values.plan,
        '--rate-control',
        values['rate-control'],
        '--mode',
        values.mode,
        ...(sensors > 1 ? ['--sim-lidars', String(sensors - 1)] : []),
        '--bitrate-mbps',
        '200',
        '--stats',
        robotFiles[i] as string,
      ],
    });
    const capacity =
      values.trace === undefined
        ? ['--rate-mbps', String(rateMbps)]
        : [
            '--up-trace',
            values.trace,
            '--down-rate-mbps',
            String(DOWNLINK_MBPS),
            ...downlinkOutages(traceOutages(values.trace)),
          ];
    const live = await startLiveStack({
      robot: robot(0),
      otherRobots: Array.from({ length: robots - 1 }, (_, i) => robot(i + 1)),
      canvas: values.canvas,
      query: `every=${drawEvery}`,
      ...(values.trace === undefined ? {} : { connectAtMbps: CONNECT_MBPS }),
      link: {
        args: [
          ...capacity,
          '--rtt-ms',
          values['rtt-ms'],
          '--jitter-ms',
          values['jitter-ms'],
          '--queue-ms',
          values['queue-ms'],
          '--loss',
          values.loss,
          '--burst-loss',
          values['burst-loss'],
          ...(values.cross === undefined ? [] : ['--up-cross', values.cross]),
        ],
        statsFile: linkFile,
        env: { FARPOINT_LOG_LEVEL: 'warn' },
      },
      log: (line) => console.error(line),
    });
    try {
      const { page, stack, browserPid } = live;
      for (let i = 1; i < robots; i++) await live.openPage(`sim-${i + 1}`);
      const link = live.link as NonNullable<typeof live.link>;
      const robotPid = stack.robot('sim-1').pid;
      const adminUrl = stack.robotAdminUrl('sim-1');
      const cpu = () => ({
        robot: cpuSecondsOfTree(robotPid),
        browser: cpuSecondsOfTree(browserPid),
        link: cpuSecondsOfTree(link.process.pid),
      });
      const stages = () => scrape(adminUrl, 'farpoint_robot_stage_seconds_total', 'stage');
      console.error(`${seconds} s`);
      // A trace may begin without service, so connections are made over an unloaded link.
      link.tell({ type: 'reset' });
      const sensorsBefore = await page.evaluate(() => window.farpoint.stats().sensors);
      const zeroMs = monotonicMs();
      const [cpuBefore, stagesBefore] = [cpu(), await stages()];
      const { series, latencies } = await drivePage(page, seconds);
      const endMs = monotonicMs();
      const [cpuAfter, stagesAfter] = [cpu(), await stages()];
      const statistics = await page.evaluate(() => window.farpoint.stats());
      const named = await page.evaluate(() => window.farpoint.sensors());
      await stack.robot('sim-1').stop();
      await live.close();

      const within = <T extends { timeMs: number }>(samples: readonly T[], fromMs: number) =>
        samples.filter(({ timeMs }) => timeMs >= fromMs && timeMs <= endMs);
      const fromMs = zeroMs + WARM_UP_MS;
      const allBins = within(readUplink(linkFile), zeroMs);
      const bins = within(allBins, fromMs);
      const allRobot = within(readRobotSamples(robotFiles[0] as string), zeroMs);
      const robotSamples = within(allRobot, fromMs);
      const pageSamples = within(series, fromMs);
      const outages = outagesOf(allBins);
      const quiet = outages.map(({ fromMs, toMs }) => ({ fromMs, toMs: toMs + MARGIN_MS }));
      const served = bins.filter(({ timeMs }) => !isWithin(outages, timeMs, timeMs));
      const tests = within(latencies, fromMs).filter(
        ({ timeMs, mtpMs }) => !isWithin(outages, timeMs - MARGIN_MS, timeMs + (mtpMs ?? 3000) + MARGIN_MS),
      );
      const answered = tests.filter(({ mtpMs }) => mtpMs !== null);
      const elapsedS = (endMs - fromMs) / 1000;
      const rises = capacityRises(allBins);
      const stage = (name: string) => (stagesAfter[name] ?? 0) - (stagesBefore[name] ?? 0);
      const cores = (name: string) => Number((stage(name) / ((endMs - zeroMs) / 1000)).toFixed(3));
      const robotCores = coresBetween(cpuBefore.robot, cpuAfter.robot, endMs - zeroMs);
      const frames = grown(pageSamples.map(({ framesDrawn }) => framesDrawn));
      const received = grown(pageSamples.map(({ packetsReceived }) => packetsReceived));
      const lost = grown(pageSamples.map(({ packetsLost }) => packetsLost));
      const bytesOf = (file: string) =>
        grown(within(readRobotSamples(file), fromMs).map(({ bytesSent }) => bytesSent));
      const ownBytes = bytesOf(robotFiles[0] as string);
      const allBytes = robotFiles.reduce((sum, file) => sum + bytesOf(file), 0);

      const mtpMs = rounded(distribution(answered.map(({ mtpMs }) => mtpMs as number)), 1);
      const partOf = (name: keyof LatencyParts) =>
        rounded(distribution(answered.flatMap(({ parts }) => (parts === null ? [] : [parts[name]]))), 1);
      const parts = {
        command: partOf('command'),
        captureWait: partOf('captureWait'),
        delivery: partOf('delivery'),
        display: partOf('display'),
      };
      const perSensor = sensorRows(named, statistics.sensors, sensorsBefore, (endMs - zeroMs) / 1000);
      const mtpFirstMs = rounded(distribution(answered.map(({ firstMs }) => firstMs as number)), 1);
      const result = {
        bench: 'link',
        link: values.trace === undefined ? `${rateMbps} Mbit/s` : basename(values.trace),
        rttMs: Number(values['rtt-ms']),
        queueLimitMs: Number(values['queue-ms']),
        loss: Number(values.loss),
        mode: values.mode,
        drawnShare: Number((1 / drawEvery).toFixed(4)),
        plan: values.plan,
        seconds: Number(((endMs - zeroMs) / 1000).toFixed(1)),
        utilisation: Number(utilisationOf(served).toFixed(3)),
        mtpMs,
        mtpFirstMs,
        mtpPartsMs: parts,
        samples: answered.length,
        unanswered: tests.length - answered.length,
        frameLatencyMs: statistics.frameLatencyMs,
        queueMs: rounded(queueQuantiles(bins.filter(({ timeMs }) => !isWithin(quiet, timeMs, timeMs))), 1),
        longestQueueAbove100Ms: longestQueueAbove(
          allBins.filter(({ timeMs }) => !isWithin(quiet, timeMs, timeMs)),
          100.5,
        ),
        pointsPerFrame: Math.round(
          grown(pageSamples.map(({ pointsDrawn }) => pointsDrawn)) / Math.max(frames, 1),
        ),
        framesPerSecond: Number((frames / elapsedS).toFixed(1)),
        lossRate: Number((lost / Math.max(lost + received, 1)).toFixed(4)),
        recoverySeconds:
          rises.length === 0 ? null : worst(rises.map(({ recoverySeconds }) => recoverySeconds)),
        rises,
        outages: describeOutages(outages, allRobot, series, zeroMs),
        shareAgainstCrossFlow: values.cross === undefined ? null : Number(shareOf(bins).toFixed(3)),
        shareAmongRobots: robots === 1 ? null : Number((ownBytes / allBytes).toFixed(3)),
        robotCpu: {
          total: robotCores,
          simulator: cores('capture'),
          sample: cores('sample'),
          pack: cores('pack'),
          send: cores('send'),
          rest:
            robotCores === null
              ? null
              : Number(
                  (
                    robotCores - ['capture', 'sample', 'pack', 'send'].reduce((sum, s) => sum + cores(s), 0)
                  ).toFixed(3),
                ),
        },
        robotMbps: Number(BitRate.toMbps(BitRate.of(ownBytes, endMs - fromMs)).toFixed(2)),
        browserCpu: coresBetween(cpuBefore.browser, cpuAfter.browser, endMs - zeroMs),
        linkCpu: coresBetween(cpuBefore.link, cpuAfter.link, endMs - zeroMs),
        renderMs: statistics.renderMs,
        framesDropped: grown(robotSamples.map(({ framesDropped }) => framesDropped)),
        canvas: values.canvas,
        sensors: perSensor,
      };

      printTable(
        ['', 'p50', 'p95', 'p99', 'max'],
        [
          ['motion to whole cloud, ms', ...distributionCells(mtpMs)],
          ['  command to the robot', ...distributionCells(parts.command)],
          ['  wait for the camera', ...distributionCells(parts.captureWait)],
          ['  capture to last arrival', ...distributionCells(parts.delivery)],
          ['  arrival to photon', ...distributionCells(parts.display)],
          ['motion to first points, ms', ...distributionCells(mtpFirstMs)],
          ['queue of the link, ms', ...distributionCells(result.queueMs)],
          ...(statistics.frameLatencyMs === null
            ? []
            : [['frame latency, ms', ...distributionCells(statistics.frameLatencyMs)]]),
          ...(statistics.renderMs === null
            ? []
            : [['render, ms', ...distributionCells(statistics.renderMs)]]),
        ],
      );
      console.log(
        `drawn: ${drawEvery === 1 ? 'all points' : `1 of ${drawEvery} points`}, ${values.canvas} pixels`,
      );
      console.log('');
      printTable(
        [
          'utilisation',
          'points a frame',
          'frames/s',
          'loss',
          'robot, cores',
          '… but simulator',
          'recovery, s',
        ],
        [
          [
            result.utilisation,
            result.pointsPerFrame,
            result.framesPerSecond,
            result.lossRate,
            robotCores,
            robotCores === null ? null : robotCores - result.robotCpu.simulator,
            result.recoverySeconds,
          ],
        ],
      );
      if (sensors > 1) {
        printTable(
          ['sensor', 'points a frame', 'frames/s', 'frame latency, ms: p50', 'p95', 'p99', 'max', 'share'],
          perSensor.map((row) => [
            row.name,
            row.pointsPerFrame,
            row.framesPerSecond,
            ...distributionCells(row.frameLatencyMs),
            row.share,
          ]),
        );
      }
      for (const { startS, endS, stoppedAfterMs, resumedAfterMs, words } of result.outages) {
        console.log(
          `no service ${startS}–${endS} s: stood after ${stoppedAfterMs ?? '–'} ms, points again after ${resumedAfterMs ?? '–'} ms; the page: ${words.join(' · ')}`,
        );
      }
      if (result.shareAgainstCrossFlow !== null)
        console.log(`share against ${values.cross}: ${(result.shareAgainstCrossFlow * 100).toFixed(0)} %`);
      if (result.shareAmongRobots !== null)
        console.log(
          `share of the first of ${robots} robots: ${(result.shareAmongRobots * 100).toFixed(0)} %`,
        );
      if (values.plot !== undefined) {
        const svg = plotLink({
          title: `Farpoint over ${result.link}, RTT ${values['rtt-ms']} ms`,
          subtitle: `${values.mode === 'auto' ? 'the whole cloud' : 'points64'}, ${values.plan} plan, ${values['rate-control']} rate; motion to photon p50 ${mtpMs.p50} ms, p95 ${mtpMs.p95} ms; utilisation ${(result.utilisation * 100).toFixed(0)} %`,
          zeroMs,
          bins: allBins,
          robot: allRobot,
          latencies: within(latencies, zeroMs),
          outages,
        });
        writeFileSync(values.plot, svg);
        console.error(`${values.plot} written`);
      }
      if (values.json) printJson(result);
    } finally {
      await live.close();
      if (values.keep === undefined) rmSync(folder, { recursive: true, force: true });
    }
  },
};
