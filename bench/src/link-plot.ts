/** Plots a run over time, as figure 6 of the paper does for its field tests. */
import { BitRate } from '@farpoint/timing';
import { BIN_MS, type LinkBin, type RobotSample, type TimeSpan } from './link-analysis.ts';
import type { LatencySample } from './link-run.ts';
import { renderChart } from './plot/chart.ts';

export interface LinkPlot {
  title: string;
  subtitle: string;
  zeroMs: number;
  bins: readonly LinkBin[];
  robot: readonly RobotSample[];
  latencies: readonly LatencySample[];
  outages: readonly TimeSpan[];
}

export function plotLink({ title, subtitle, zeroMs, bins, robot, latencies, outages }: LinkPlot): string {
  const seconds = (timeMs: number) => (timeMs - zeroMs) / 1000;
  const binTimes = bins.map(({ timeMs }) => seconds(timeMs));
  const robotTimes = robot.map(({ timeMs }) => seconds(timeMs));
  const mbps = (bytes: number) => BitRate.toMbps(BitRate.of(bytes, BIN_MS));
  const answered = latencies.filter(({ mtpMs }) => mtpMs !== null);
  const spans = outages.map(({ fromMs, toMs }) => ({
    from: seconds(fromMs),
    to: seconds(toMs),
    label: 'no service',
  }));
  const xLabel = 'time, s';
  return renderChart({
    title,
    subtitle,
    columns: 1,
    panelWidth: 960,
    panelHeight: 230,
    panels: [
      {
        title: 'Bit rate',
        xLabel,
        yLabel: 'Mbit/s',
        spans,
        series: [
          {
            label: 'capacity',
            x: binTimes,
            y: bins.map((bin) => bin.capacityMbps ?? Number.NaN),
            shape: 'area',
          },
          { label: 'delivered', x: binTimes, y: bins.map((bin) => mbps(bin.deliveredBytes)) },
          {
            label: 'estimate',
            x: robotTimes,
            y: robot.map((sample) => BitRate.toMbps(sample.estimateBitsPerSecond)),
          },
          ...(bins.some((bin) => bin.crossBytes > 0)
            ? [{ label: 'competing flow', x: binTimes, y: bins.map((bin) => mbps(bin.crossBytes)) }]
            : []),
        ],
      },
      {
        title: 'Latency',
        xLabel,
        yLabel: 'ms',
        spans,
        series: [
          {
            label: 'motion to photon, whole cloud',
            x: answered.map(({ timeMs }) => seconds(timeMs)),
            y: answered.map(({ mtpMs }) => mtpMs as number),
          },
          { label: 'queue of the link', x: binTimes, y: bins.map(({ queueMsMax }) => queueMsMax) },
        ],
      },
      {
        title: 'Points a frame',
        xLabel,
        yLabel: 'points',
        spans,
        series: [{ label: 'points', x: robotTimes, y: robot.map(({ pointsPerFrame }) => pointsPerFrame) }],
      },
      {
        title: 'Frames a second',
        xLabel,
        yLabel: 'frames/s',
        spans,
        series: [{ label: 'planned', x: robotTimes, y: robot.map(({ framesPerSecond }) => framesPerSecond) }],
      },
    ],
  });
}
