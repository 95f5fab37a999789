/** The figures of `pnpm bench link`. */
import { basename } from 'node:path';
import { BitRate } from '@farpoint/timing';
import {
  capacityRises,
  describeOutages,
  grown,
  longestQueueAbove,
  type PageSample,
  queueQuantiles,
  shareOf,
  utilisationOf,
  worst,
} from './link-analysis.ts';
import type { LinkOptions } from './link-options.ts';
import type { LatencyParts, LatencySample } from './link-run.ts';
import type { LinkSamples, TimedRun } from './link-samples.ts';
import { type SensorSums, sensorRows } from './sensor-rows.ts';
import { distribution, rounded } from './stats.ts';

/** A run, and the processor time of its programs. */
export interface LinkRecord extends TimedRun {
  /** Cores; `null` without /proc. */
  robotCores: number | null;
  browserCores: number | null;
  linkCores: number | null;
  /** Processor time of the robot by stage since it started, s. */
  stagesBefore: Record<string, number>;
  stagesAfter: Record<string, number>;
  /** The page's statistics at the end. */
  statistics: ReturnType<Window['farpoint']['stats']>;
  sensorsBefore: SensorSums[];
  /** The robot's sensors, in their order. */
  named: readonly { name: string }[];
}

/** The object that `--json` prints. */
export type LinkFigures = ReturnType<typeof linkFigures>;

export function linkFigures(options: LinkOptions, record: LinkRecord, samples: LinkSamples) {
  const { robots, cross, canvas } = options;
  const { zeroMs, endMs, statistics } = record;
  const { ownBytes, allBytes } = samples;
  const seconds = (endMs - zeroMs) / 1000;
  const rises = capacityRises(samples.allBins);
  return {
    bench: 'link',
    ...settingsOf(options),
    seconds: Number(seconds.toFixed(1)),
    utilisation: Number(utilisationOf(samples.servedBins).toFixed(3)),
    ...latencyFigures(samples.tests),
    frameLatencyMs: statistics.frameLatencyMs,
    queueMs: rounded(queueQuantiles(samples.calmBins), 1),
    longestQueueAbove100Ms: longestQueueAbove(samples.allCalmBins, 100.5),
    ...streamFigures(samples.page, samples.elapsedMs / 1000),
    recoverySeconds: rises.length === 0 ? null : worst(rises.map(({ recoverySeconds }) => recoverySeconds)),
    rises,
    outages: describeOutages(samples.outages, samples.allRobot, record.series, zeroMs),
    shareAgainstCrossFlow: cross === undefined ? null : Number(shareOf(samples.bins).toFixed(3)),
    shareAmongRobots: robots === 1 ? null : Number((ownBytes / allBytes).toFixed(3)),
    robotCpu: robotCpuOf(record),
    robotMbps: Number(BitRate.toMbps(BitRate.of(ownBytes, samples.elapsedMs)).toFixed(2)),
    browserCpu: record.browserCores,
    linkCpu: record.linkCores,
    renderMs: statistics.renderMs,
    framesDropped: grown(samples.robot.map(({ framesDropped }) => framesDropped)),
    canvas,
    sensors: sensorRows(record.named, statistics.sensors, record.sensorsBefore, seconds),
  };
}

function settingsOf({ trace, rateMbps, rttMs, queueMs, loss, mode, drawEvery, plan }: LinkOptions) {
  return {
    link: trace === undefined ? `${rateMbps} Mbit/s` : basename(trace),
    rttMs,
    queueLimitMs: queueMs,
    loss,
    mode,
    drawnShare: Number((1 / drawEvery).toFixed(4)),
    plan,
  };
}

function latencyFigures(tests: readonly LatencySample[]) {
  const answered = tests.filter(({ mtpMs }) => mtpMs !== null);
  const partOf = (name: keyof LatencyParts) =>
    rounded(distribution(answered.flatMap(({ parts }) => (parts === null ? [] : [parts[name]]))), 1);
  return {
    mtpMs: rounded(distribution(answered.map(({ mtpMs }) => mtpMs as number)), 1),
    mtpFirstMs: rounded(distribution(answered.map(({ firstMs }) => firstMs as number)), 1),
    mtpPartsMs: {
      command: partOf('command'),
      captureWait: partOf('captureWait'),
      delivery: partOf('delivery'),
      display: partOf('display'),
    },
    samples: answered.length,
    unanswered: tests.length - answered.length,
  };
}

/** Figures of the stream that the page received and drew. */
function streamFigures(page: readonly PageSample[], elapsedS: number) {
  const frames = grown(page.map(({ framesDrawn }) => framesDrawn));
  const points = grown(page.map(({ pointsDrawn }) => pointsDrawn));
  const received = grown(page.map(({ packetsReceived }) => packetsReceived));
  const lost = grown(page.map(({ packetsLost }) => packetsLost));
  return {
    pointsPerFrame: Math.round(points / Math.max(frames, 1)),
    framesPerSecond: Number((frames / elapsedS).toFixed(1)),
    lossRate: Number((lost / Math.max(lost + received, 1)).toFixed(4)),
  };
}

/** Cores of the robot, by stage of a frame; `total` is `null` without /proc. */
function robotCpuOf({ robotCores: total, stagesBefore, stagesAfter, zeroMs, endMs }: LinkRecord) {
  const cores = (stage: string) =>
    Number((((stagesAfter[stage] ?? 0) - (stagesBefore[stage] ?? 0)) / ((endMs - zeroMs) / 1000)).toFixed(3));
  const stages = {
    simulator: cores('capture'),
    sample: cores('sample'),
    pack: cores('pack'),
    send: cores('send'),
  };
  const known = Object.values(stages).reduce((sum, each) => sum + each, 0);
  return { total, ...stages, rest: total === null ? null : Number((total - known).toFixed(3)) };
}
