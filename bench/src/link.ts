/** `pnpm bench link`: the real robot and the real browser over an emulated link. */

import { writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { processFolder } from '@farpoint/local-stack';
import { coresBetween, cpuSecondsOfTree } from './cpu-time.ts';
import { type LinkRecord, linkFigures } from './link-figures.ts';
import { LINK_USAGE, type LinkOptions, readLinkOptions } from './link-options.ts';
import { downlinkOutages, traceOutages } from './link-outages.ts';
import { plotLink } from './link-plot.ts';
import { plotTitles, printLink } from './link-report.ts';
import { drivePage, scrape } from './link-run.ts';
import { type LinkFiles, linkSamples } from './link-samples.ts';
import { type LiveStack, type LiveStackOptions, startLiveStack } from './live-stack.ts';
import { monotonicMs } from './measured-span.ts';
import { type Bench, printJson } from './report.ts';

const DOWNLINK_MBPS = 50;
/** Capacity before a trace begins. */
const CONNECT_MBPS = 10;

export const bench: Bench = {
  name: 'link',
  summary: 'the whole stack over an emulated link: utilisation, latency, recovery',
  usage: LINK_USAGE,
  async run(argv) {
    const options = readLinkOptions(argv);
    const { robots, keep, plot } = options;

    const folder = keep ?? processFolder();
    const files: LinkFiles = {
      link: join(folder, 'link.jsonl'),
      robots: Array.from({ length: robots }, (_, i) => join(folder, `robot-${i + 1}`, 'streams.jsonl')),
    };
    const live = await startLiveStack(stackOptions(options, files));
    try {
      const record = await drive(live, options);
      await live.close();
      const samples = linkSamples(record, files);
      const result = linkFigures(options, record, samples);
      printLink(options, result);
      if (plot !== undefined) {
        const { allBins: bins, allRobot: robot, allLatencies: latencies, outages } = samples;
        const titles = plotTitles(options, result);
        const svg = plotLink({ ...titles, zeroMs: record.zeroMs, bins, robot, latencies, outages });
        writeFileSync(plot, svg);
        console.error(`${plot} written`);
      }
      if (options.json) printJson(result);
    } finally {
      await live.close();
    }
  },
};

function stackOptions(options: LinkOptions, files: LinkFiles): LiveStackOptions {
  const { canvas, drawEvery, trace } = options;
  const [first, ...others] = files.robots.map((statsFile, i) => ({
    id: `sim-${i + 1}`,
    name: `Simulated robot ${i + 1}`,
    args: robotArgs(options, statsFile),
  }));
  return {
    robot: first as NonNullable<typeof first>,
    otherRobots: others,
    canvas,
    query: `every=${drawEvery}`,
    ...(trace === undefined ? {} : { connectAtMbps: CONNECT_MBPS }),
    link: {
      args: linkArgs(options),
      statsFile: files.link,
      env: { FARPOINT_LOG_LEVEL: 'warn' },
    },
    log: (line) => console.error(line),
  };
}

function robotArgs({ fps, plan, rateControl, mode, sensors }: LinkOptions, statsFile: string): string[] {
  return [
    '--fps',
    String(fps),
    '--plan',
    plan,
    '--rate-control',
    rateControl,
    '--mode',
    mode,
    ...(sensors > 1 ? ['--sim-lidars', String(sensors - 1)] : []),
    '--bitrate-mbps',
    '200',
    '--measure',
    dirname(statsFile),
  ];
}

function linkArgs({ rateMbps, trace, cross, ...link }: LinkOptions): string[] {
  const capacity =
    trace === undefined
      ? ['--rate-mbps', String(rateMbps)]
      : [
          '--up-trace',
          trace,
          '--down-rate-mbps',
          String(DOWNLINK_MBPS),
          ...downlinkOutages(traceOutages(trace)),
        ];
  return [
    ...capacity,
    '--rtt-ms',
    String(link.rttMs),
    '--jitter-ms',
    String(link.jitterMs),
    '--queue-ms',
    String(link.queueMs),
    '--loss',
    String(link.loss),
    '--burst-loss',
    String(link.burstLoss),
    ...(cross === undefined ? [] : ['--up-cross', cross]),
  ];
}

/** Drives the first robot while the others stream beside it, and stops it. */
async function drive(live: LiveStack, { robots, seconds }: LinkOptions): Promise<LinkRecord> {
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
  return {
    zeroMs,
    endMs,
    series,
    latencies,
    robotCores: coresBetween(cpuBefore.robot, cpuAfter.robot, endMs - zeroMs),
    browserCores: coresBetween(cpuBefore.browser, cpuAfter.browser, endMs - zeroMs),
    linkCores: coresBetween(cpuBefore.link, cpuAfter.link, endMs - zeroMs),
    stagesBefore,
    stagesAfter,
    statistics,
    sensorsBefore,
    named,
  };
}
