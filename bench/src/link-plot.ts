/** Plots a run over time, as figure 6 of the paper does for its field tests. */
import { BitRate } from '@farpoint/timing';
import { BIN_MS, type LinkBin, type RobotSample, type TimeSpan } from './link-analysis.ts';
import type { LatencySample } from './link-run.ts';
import { renderChart, type Series } from './plot/chart.ts';

export interface LinkPlot {
  title: string;
  subtitle: string;
  zeroMs: number;
  bins: readonly LinkBin[];
  robot: readonly RobotSample[];
  latencies: readonly LatencySample[];
  outages: readonly TimeSpan[];
}

export function plotLink(plot: LinkPlot): string {
  const { title, subtitle, zeroMs, robot } = plot;
  const seconds = (timeMs: number) => (timeMs - zeroMs) / 1000;
  const robotTimes = robot.map(({ timeMs }) => seconds(timeMs));
  const spans = plot.outages.map(({ fromMs, toMs }) => ({
    from: seconds(fromMs),
    to: seconds(toMs),
    label: 'no service',
  }));
  const axes = { xLabel: 'time, s', spans };
  return renderChart({
    title,
    subtitle,
    columns: 1,
    panelWidth: 960,
    panelHeight: 230,
    panels: [
      { ...axes, title: 'Bit rate', yLabel: 'Mbit/s', series: bitRates(plot, seconds) },
      { ...axes, title: 'Latency', yLabel: 'ms', series: latencySeries(plot, seconds) },
      {
        ...axes,
        title: 'Points a frame',
        yLabel: 'points',
        series: [{ label: 'points', x: robotTimes, y: robot.map(({ pointsPerFrame }) => pointsPerFrame) }],
      },
      {
        ...axes,
        title: 'Frames a second',
        yLabel: 'frames/s',
        series: [{ label: 'planned', x: robotTimes, y: robot.map(({ framesPerSecond }) => framesPerSecond) }],
      },
    ],
  });
}

/** @param seconds converts a time to the plot's axis */
function bitRates({ bins, robot }: LinkPlot, seconds: (timeMs: number) => number): Series[] {
  const times = bins.map(({ timeMs }) => seconds(timeMs));
  const mbps = (bytes: number) => BitRate.toMbps(BitRate.of(bytes, BIN_MS));
  const series: Series[] = [
    {
      label: 'capacity',
      x: times,
      y: bins.map((bin) => bin.capacityMbps ?? Number.NaN),
      shape: 'area',
    },
    { label: 'delivered', x: times, y: bins.map((bin) => mbps(bin.deliveredBytes)) },
    {
      label: 'estimate',
      x: robot.map(({ timeMs }) => seconds(timeMs)),
      y: robot.map((sample) => BitRate.toMbps(sample.estimateBitsPerSecond)),
    },
  ];
  if (bins.some((bin) => bin.crossBytes > 0))
    series.push({ label: 'competing flow', x: times, y: bins.map((bin) => mbps(bin.crossBytes)) });
  return series;
}

/** @param seconds converts a time to the plot's axis */
function latencySeries({ bins, latencies }: LinkPlot, seconds: (timeMs: number) => number): Series[] {
  const answered = latencies.filter(({ mtpMs }) => mtpMs !== null);
  return [
    {
      label: 'motion to photon, whole cloud',
      x: answered.map(({ timeMs }) => seconds(timeMs)),
      y: answered.map(({ mtpMs }) => mtpMs as number),
    },
    {
      label: 'queue of the link',
      x: bins.map(({ timeMs }) => seconds(timeMs)),
      y: bins.map(({ queueMsMax }) => queueMsMax),
    },
  ];
}
