/** `pnpm bench link`: the real robot and the real browser over an emulated link. */
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { parseArgs } from 'node:util';
import { parseTrace } from '@farpoint/link-emulator';
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
} from './link-analysis.ts';
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
import { type Bench, distributionCells, numberOption, printJson, printTable } from './report.ts';
import { distribution, rounded } from './stats.ts';

const USAGE = `pnpm bench link [options]

Real robot (simulated office), signaling and headless Chromium; all packets between robot and browser pass an emulated link.
The operator drives in circles and tests the latency again and again: from an input event to the end of the display frame
that shows the whole green cloud (mtpMs), or its first points (mtpFirstMs). Figures are of the time after the first 5 s.

  --rate-mbps 41.44   capacity, both ways, 10^6 bit/s on the wire
  --trace FILE        capacity from the robot over time, CSV time_s,capacity_mbps; the other way has 50 Mbit/s, and nothing
                      while the trace has nothing
  --rtt-ms 42.4       propagation, both ways together
  --jitter-ms 0  --loss 0  --burst-loss 0  --queue-ms 100
  --cross KIND        a competing flow from the robot's side: cubic, reno
  --robots 1          so many robots stream over the same link, each to a page of its own; the first one is measured
  --seconds 30        how long; a trace begins anew when the measurement begins
  --mode points64     points64, or auto: the best format that both sides know, the whole cloud where the rate allows
  --draw-every N      every N-th point that comes is drawn, all are decoded: where the GPU is a processor, drawing would
                      be what is measured. 8 for points64, 192 for auto, some
                      1,000 points a picture; 1 draws all
  --fps 60            most frames a second that the camera is asked for
  --plan latency      or paper: every frame, points by the paper's equations 2 and 3
  --rate-control adaptive   or fixed
  --canvas 160x90     drawn by software: the stream is to be measured, not the renderer
  --plot FILE.svg     capacity, estimate, delivered rate, latency, points and frames over time
  --json`;

/** Begins with the link's own start: the rate is still being found. */
const WARM_UP_MS = 5000;
const DOWNLINK_MBPS = 50;
/** Before a trace begins. */
const CONNECT_MBPS = 10;
/** A test that is under way when the service ends or begins says nothing of the link with service. */
const MARGIN_MS = 500;

/** About a thousand points a display frame, of a sample and of a whole cloud. */
const DRAW_EVERY = { points64: '8', auto: '192' } as const;

export const bench: Bench = {
  name: 'link',
  summary: 'the whole stack over an emulated link: utilisation, latency, recovery',
  async run(argv) {
    const { values } = parseArgs({
      args: argv,
      options: {
        'rate-mbps': { type: 'string' },
        trace: { type: 'string' },
        'rtt-ms': { type: 'string', default: '42.4' },
        'jitter-ms': { type: 'string', default: '0' },
        loss: { type: 'string', default: '0' },
        'burst-loss': { type: 'string', default: '0' },
        'queue-ms': { type: 'string', default: '100' },
        cross: { type: 'string' },
        robots: { type: 'string', default: '1' },
        seconds: { type: 'string', default: '30' },
        mode: { type: 'string', default: 'points64' },
        'draw-every': { type: 'string' },
        fps: { type: 'string', default: '60' },
        plan: { type: 'string', default: 'latency' },
        'rate-control': { type: 'string', default: 'adaptive' },
        canvas: { type: 'string', default: '160x90' },
        plot: { type: 'string' },
        keep: { type: 'string' },
        json: { type: 'boolean' },
        help: { type: 'boolean' },
      },
    });
    if (values.help) return console.log(USAGE);
    if (values.trace !== undefined && values['rate-mbps'] !== undefined)
      throw new Error('--rate-mbps and --trace exclude each other');
    if (values.mode !== 'points64' && values.mode !== 'auto')
      throw new Error(`--mode is \`${values.mode}\`, not points64 or auto`);
    const rateMbps = numberOption('rate-mbps', values['rate-mbps'] ?? '41.44', 0.1);
    const seconds = numberOption('seconds', values.seconds, 6);
    const drawEvery = numberOption('draw-every', values['draw-every'] ?? DRAW_EVERY[values.mode], 1);
    const robots = numberOption('robots', values.robots, 1);
    const fps = numberOption('fps', values.fps, 1);

    const folder = values.keep ?? mkdtempSync(join(tmpdir(), 'farpoint-link-'));
    const linkFile = join(folder, 'link.jsonl');
    const robotFiles = Array.from({ length: robots }, (_, i) => join(folder, `robot-${i + 1}.jsonl`));
    const robot = (i: number) => ({
      id: `sim-${i + 1}`,
      name: `Simulated robot ${i + 1}`,
      args: [
        ...['--fps', String(fps), '--plan', values.plan, '--rate-control', values['rate-control']],
        ...['--mode', values.mode],
        ...['--bitrate-mbps', '200', '--stats', robotFiles[i] as string],
      ],
    });
    const capacity =
      values.trace === undefined
        ? ['--rate-mbps', String(rateMbps)]
        : [
            ...['--up-trace', values.trace, '--down-rate-mbps', String(DOWNLINK_MBPS)],
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
          ...[
            '--rtt-ms',
            values['rtt-ms'],
            '--jitter-ms',
            values['jitter-ms'],
            '--queue-ms',
            values['queue-ms'],
          ],
          ...['--loss', values.loss, '--burst-loss', values['burst-loss']],
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
      // A trace may begin without service: connections are made over a quiet link.
      link.tell({ type: 'reset' });
      const zeroMs = monotonicMs();
      const [cpuBefore, stagesBefore] = [cpu(), await stages()];
      const { series, latencies } = await drivePage(page, seconds);
      const endMs = monotonicMs();
      const [cpuAfter, stagesAfter] = [cpu(), await stages()];
      const statistics = await page.evaluate(() => window.farpoint.stats());
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
      const mtpFirstMs = rounded(distribution(answered.map(({ firstMs }) => firstMs as number)), 1);
      const result = {
        bench: 'link',
        link: values.trace === undefined ? `${rateMbps} Mbit/s` : basename(values.trace),
        ...{
          rttMs: Number(values['rtt-ms']),
          queueLimitMs: Number(values['queue-ms']),
          loss: Number(values.loss),
        },
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
        robotMbps: Number(((ownBytes * 8) / elapsedS / 1e6).toFixed(2)),
        browserCpu: coresBetween(cpuBefore.browser, cpuAfter.browser, endMs - zeroMs),
        linkCpu: coresBetween(cpuBefore.link, cpuAfter.link, endMs - zeroMs),
        renderMs: statistics.renderMs,
        framesDropped: grown(robotSamples.map(({ framesDropped }) => framesDropped)),
        canvas: values.canvas,
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
            ...[result.utilisation, result.pointsPerFrame, result.framesPerSecond, result.lossRate],
            ...[robotCores, robotCores === null ? null : robotCores - result.robotCpu.simulator],
            result.recoverySeconds,
          ],
        ],
      );
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
          ...{ zeroMs, bins: allBins, robot: allRobot, latencies: within(latencies, zeroMs), outages },
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

/** The worst; `null` where one never came about. */
function worst(times: readonly (number | null)[]): number | null {
  return times.some((time) => time === null) ? null : Math.max(...(times as number[]));
}

/** Seconds of the trace without service, in which nothing comes back either. */
function traceOutages(path: string): { from: number; to: number }[] {
  const { steps } = parseTrace(readFileSync(path, 'utf8'));
  const capacities = steps.map(({ atMs, mbps }) => ({ timeMs: atMs, capacityMbps: mbps }));
  return outagesOf(capacities).map(({ fromMs, toMs }) => ({ from: fromMs / 1000, to: toMs / 1000 }));
}

function downlinkOutages(spans: readonly { from: number; to: number }[]): string[] {
  return spans.length === 0 ? [] : ['--down-outages', spans.map(({ from, to }) => `${from}-${to}`).join(',')];
}
