/** Plots of latency over time, as the thesis shows them in its figures 13 to 22. */
import type { CameraRun } from './camera-run.ts';
import { AVERAGED_S } from './latency-series.ts';
import { type Panel, renderChart } from './plot/chart.ts';

export interface PlottedRun {
  title: string;
  run: Pick<CameraRun, 'series'>;
}

/** @param subtitle what all runs have in common */
export function plotCameras(title: string, subtitle: string, runs: readonly PlottedRun[]): string {
  return renderChart({
    title,
    subtitle: `${subtitle}; averages of ${AVERAGED_S} s, from capture to the end of the display frame`,
    columns: 2,
    panelWidth: 560,
    panelHeight: 240,
    panels: runs.map(panelOf),
  });
}

function panelOf({ title, run }: PlottedRun): Panel {
  return {
    title,
    xLabel: 'time, s',
    yLabel: 'glass to glass, ms',
    series: run.series.map(({ s, ms }, camera) => ({
      label: `camera ${camera + 1}`,
      x: s,
      y: ms,
      // Cameras in step lie on one another.
      dashed: camera > 0,
    })),
  };
}
