/** Samples of the link, the robots and the page in a run of `pnpm bench link`, and which of them count. */
import {
  grown,
  isWithin,
  type LinkBin,
  outagesOf,
  type PageSample,
  type RobotSample,
  type TimeSpan,
} from './link-analysis.ts';
import { type LatencySample, type PageRun, readRobotSamples, readUplink } from './link-run.ts';

/** Excluded from the start of the link on, because the rate is still being found. */
const WARM_UP_MS = 5000;
/** A latency test in progress when the service ends or begins says nothing about the link in service. */
const MARGIN_MS = 500;

/** Files in which the link and each robot record. */
export interface LinkFiles {
  link: string;
  robots: string[];
}

/** A page's run, and when it began and ended on the robot's clock, ms. */
export interface TimedRun extends PageRun {
  zeroMs: number;
  endMs: number;
}

export interface LinkSamples {
  /** Those whose names begin with `all` are from the start of the link on, the others without the warm-up. */
  allBins: LinkBin[];
  allRobot: RobotSample[];
  allLatencies: LatencySample[];
  bins: LinkBin[];
  /** Bins outside of outages. */
  servedBins: LinkBin[];
  /** Bins outside of outages and of the time after them in which the queue drains. */
  allCalmBins: LinkBin[];
  calmBins: LinkBin[];
  robot: RobotSample[];
  page: PageSample[];
  /** Tests in which the link was in service all the time. */
  tests: LatencySample[];
  outages: TimeSpan[];
  /** Bytes that the first robot sent, and those of all robots. */
  ownBytes: number;
  allBytes: number;
  /** From the warm-up to the end, ms. */
  elapsedMs: number;
}

export function linkSamples({ zeroMs, endMs, series, latencies }: TimedRun, files: LinkFiles): LinkSamples {
  const within = <T extends { timeMs: number }>(samples: readonly T[], fromMs: number) =>
    samples.filter(({ timeMs }) => timeMs >= fromMs && timeMs <= endMs);
  const fromMs = zeroMs + WARM_UP_MS;
  const allBins = within(readUplink(files.link), zeroMs);
  const bins = within(allBins, fromMs);
  const allRobot = within(readRobotSamples(files.robots[0] as string), zeroMs);
  const outages = outagesOf(allBins);
  const quiet = outages.map(({ fromMs, toMs }) => ({ fromMs, toMs: toMs + MARGIN_MS }));
  const isCalm = ({ timeMs }: LinkBin) => !isWithin(quiet, timeMs, timeMs);
  const bytesOf = (file: string) =>
    grown(within(readRobotSamples(file), fromMs).map(({ bytesSent }) => bytesSent));
  return {
    allBins,
    allRobot,
    allLatencies: within(latencies, zeroMs),
    bins,
    servedBins: bins.filter(({ timeMs }) => !isWithin(outages, timeMs, timeMs)),
    allCalmBins: allBins.filter(isCalm),
    calmBins: bins.filter(isCalm),
    robot: within(allRobot, fromMs),
    page: within(series, fromMs),
    tests: within(latencies, fromMs).filter(
      ({ timeMs, mtpMs }) => !isWithin(outages, timeMs - MARGIN_MS, timeMs + (mtpMs ?? 3000) + MARGIN_MS),
    ),
    outages,
    ownBytes: bytesOf(files.robots[0] as string),
    allBytes: files.robots.reduce((sum, file) => sum + bytesOf(file), 0),
    elapsedMs: endMs - fromMs,
  };
}
