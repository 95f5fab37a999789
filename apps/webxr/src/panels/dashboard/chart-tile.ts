/** A tile with a number over time, drawn by uPlot: at most two points a column, and no more often than it would show. */
import uPlot from 'uplot';
import { Curve } from '../../ground/telemetry/curve.ts';
import { shownAt } from '../../ground/telemetry/moment.ts';
import type { RecordedSeries } from '../../ground/telemetry/recorder.ts';
import { ageText, numberText, spanText, withUnit } from './number-words.ts';
import { part, setText, type Tile, type TileFrame } from './tile.ts';

const GRID = { stroke: '#24303b', width: 1 };
const TICKS = { stroke: '#24303b', width: 1, size: 4 };
const TEXT = '#8fa3b3';
const LINE = '#35c9b5';
const STALE_LINE = '#5d6d7a';
const FONT = '11px system-ui, sans-serif';
const HEIGHT = 130;
const AXIS_WIDTH = 44;
const LEAST_WIDTH = 80;
/** The largest value must not touch the edge. */
const PADDING = 0.08;
/** Time between two updates of the present value, ms. */
const VALUE_MS = 100;
/** A curve is drawn when it has moved by a column, but not more and not less often than this, ms. */
const LEAST_MS = 50;
const MOST_MS = 2000;

/** @param recorded read anew each time, because a robot may describe it again */
export function chartTile(recorded: () => RecordedSeries | undefined): Tile {
  const element = part('chart');
  const figures = part('figures');
  const [now, least, most] = [part('now', 'output'), part('least'), part('most')] as [
    HTMLElement,
    HTMLElement,
    HTMLElement,
  ];
  now.ariaLive = 'off';
  figures.append(now, least, most);
  const plotted = part('plot');
  plotted.ariaHidden = 'true';
  element.append(figures, plotted);
  const curve = new Curve();
  let unit = '';
  let stale = false;
  let windowS = 30;
  let curveDueMs = 0;
  let columnMs = LEAST_MS;
  let drawnStale: boolean | null = null;
  const plot = new uPlot(
    {
      width: LEAST_WIDTH,
      height: HEIGHT,
      padding: [6, 16, 0, 0],
      legend: { show: false },
      cursor: { show: false },
      select: { show: false } as uPlot.Select,
      scales: {
        x: { time: false, range: () => [-windowS, 0] },
        y: { range: (_, low, high) => padded(low, high) },
      },
      axes: [
        {
          stroke: TEXT,
          grid: GRID,
          ticks: TICKS,
          font: FONT,
          size: 26,
          space: 60,
          values: (_, splits) => splits.map((at) => (at === 0 ? 'now' : `−${spanWords(-at)}`)),
          incrs: [5, 10, 30, 60, 120, 300, 600, 1200],
        },
        {
          stroke: TEXT,
          grid: GRID,
          ticks: TICKS,
          font: FONT,
          size: AXIS_WIDTH,
          space: 26,
          values: (_, splits) => splits.map((at) => String(Number(at.toPrecision(6)))),
        },
      ],
      series: [
        {},
        { stroke: () => (stale ? STALE_LINE : LINE), width: 1.5, points: { show: false }, spanGaps: false },
      ],
    },
    [[], []],
    plotted,
  );
  const resizing = new ResizeObserver(([entry]) => {
    const width = Math.max(LEAST_WIDTH, Math.floor(entry?.contentRect.width ?? 0));
    curve.columns = Math.max(1, width - AXIS_WIDTH);
    if (width !== plot.width) plot.setSize({ width, height: HEIGHT });
  });
  resizing.observe(plotted);

  function write(frame: TileFrame): void {
    const described = recorded();
    const shown = shownAt(described?.series, frame.moment);
    unit = described?.unit ?? '';
    stale = shown?.stale ?? true;
    element.dataset.stale = String(stale);
    const value = shown === null ? '–' : withUnit(shown.value, unit);
    setText(now, stale && shown !== null ? `${value} (${ageText(shown.ageMs)} old)` : value);
  }

  return {
    element,
    everyMs: () => Math.min(columnMs, VALUE_MS),
    update(frame) {
      write(frame);
      columnMs = Math.min(Math.max(frame.windowMs / plot.width, LEAST_MS), MOST_MS);
      // A window that was chosen just now, or a robot that returned, is shown at once.
      const isSame = windowS === frame.windowMs / 1000 && drawnStale === stale;
      if (isSame && frame.nowMs < curveDueMs) return;
      curveDueMs = frame.nowMs + columnMs;
      drawnStale = stale;
      const { instantMs, robotNowMs } = frame.moment;
      const endMs = instantMs ?? robotNowMs;
      const described = recorded();
      windowS = frame.windowMs / 1000;
      const range = described?.series.range(endMs - frame.windowMs, endMs) ?? null;
      setText(least, range === null ? 'min –' : `min ${numberText(range.least, unit)}`);
      setText(most, range === null ? 'max –' : `max ${numberText(range.most, unit)}`);
      if (described === undefined) return;
      described.series.curve(endMs - frame.windowMs, endMs, curve);
      plot.setData([curve.xs, curve.ys]);
    },
    dispose() {
      resizing.disconnect();
      plot.destroy();
    },
  };
}

function spanWords(seconds: number): string {
  return seconds % 60 === 0 ? spanText(seconds) : `${seconds} s`;
}

function padded(low: number | null, high: number | null): [number, number] {
  if (low === null || high === null) return [0, 1];
  // A steady value is a line in the middle, not noise that fills the chart.
  const span = Math.max(high - low, Math.abs(high) * 0.02, 0.1);
  const middle = (low + high) / 2;
  return [middle - span * (0.5 + PADDING), middle + span * (0.5 + PADDING)];
}
