/** A tile with a number over time, drawn by uPlot: at most two points a column, and no more often than it would show. */
import uPlot from 'uplot';
import { palette } from '../../ground/display/palette.ts';
import { Curve } from '../../ground/telemetry/curve.ts';
import { shownAt } from '../../ground/telemetry/moment.ts';
import type { RecordedSeries } from '../../ground/telemetry/recorder.ts';
import { texts } from '../../words/language.ts';
import { marked } from '../../words/numbers.ts';
import { ageText, numberText, spanText, withUnit } from './number-words.ts';
import { part, setText, type Tile, type TileFrame } from './tile.ts';

const GRID = { stroke: () => palette.line, width: 1 };
const TICKS = { ...GRID, size: 4 };
const quiet = () => palette.quiet;
const FONT = '11px system-ui, sans-serif';
/** Sizes in CSS pixels. Chosen by eye: an axis' numbers fit their column. */
const HEIGHT = 130;
const AXIS_WIDTH = 44;
const LEAST_WIDTH = 80;
/** The largest value must not touch the edge. */
const PADDING = 0.08;
/** Time between two updates of the present value, ms. Chosen: faster digits cannot be read. */
const VALUE_MS = 100;
/**
 * A curve is drawn when it has moved by a column, but not more and not less often than this, ms: telemetry
 * comes as often.
 */
const LEAST_MS = 50;
const MOST_MS = 2000;

export class ChartTile implements Tile {
  readonly element = part('chart');
  readonly #recorded: () => RecordedSeries | undefined;
  readonly #now = part('now', 'output');
  readonly #least = part('least');
  readonly #most = part('most');
  readonly #curve = new Curve();
  readonly #plot: uPlot;
  readonly #resizing: ResizeObserver;
  #unit = '';
  #stale = false;
  #windowS = 30;
  #curveDueMs = 0;
  #columnMs = LEAST_MS;
  #drawnStale: boolean | null = null;
  #drawnPalette = -1;

  /** @param recorded read anew each time, because a robot may describe it again */
  constructor(recorded: () => RecordedSeries | undefined) {
    this.#recorded = recorded;
    const figures = part('figures');
    this.#now.ariaLive = 'off';
    figures.append(this.#now, this.#least, this.#most);
    const plotted = part('plot');
    plotted.ariaHidden = 'true';
    this.element.append(figures, plotted);
    const options = chartOptions(
      () => this.#windowS,
      () => this.#stale,
    );
    this.#plot = new uPlot(options, [[], []], plotted);
    this.#resizing = new ResizeObserver(([entry]) => this.#fit(entry?.contentRect.width ?? 0));
    this.#resizing.observe(plotted);
  }

  everyMs(): number {
    return Math.min(this.#columnMs, VALUE_MS);
  }

  update(frame: TileFrame): void {
    this.#writeNow(frame);
    this.#columnMs = Math.min(Math.max(frame.windowMs / this.#plot.width, LEAST_MS), MOST_MS);
    // A window or theme that was chosen just now, or a robot that returned, is shown at once.
    const isDrawn = this.#drawnStale === this.#stale && this.#drawnPalette === palette.version;
    const isSame = this.#windowS === frame.windowMs / 1000 && isDrawn;
    if (isSame && frame.nowMs < this.#curveDueMs) return;
    this.#curveDueMs = frame.nowMs + this.#columnMs;
    this.#drawnStale = this.#stale;
    this.#drawnPalette = palette.version;
    this.#drawCurve(frame);
  }

  dispose(): void {
    this.#resizing.disconnect();
    this.#plot.destroy();
  }

  #fit(contentWidth: number): void {
    const width = Math.max(LEAST_WIDTH, Math.floor(contentWidth));
    this.#curve.columns = Math.max(1, width - AXIS_WIDTH);
    if (width !== this.#plot.width) this.#plot.setSize({ width, height: HEIGHT });
  }

  #writeNow(frame: TileFrame): void {
    const described = this.#recorded();
    const shown = shownAt(described?.series, frame.moment);
    this.#unit = described?.unit ?? '';
    this.#stale = shown?.stale ?? true;
    this.element.dataset.stale = String(this.#stale);
    const value = shown === null ? '–' : withUnit(shown.value, this.#unit);
    const isOld = this.#stale && shown !== null;
    setText(this.#now, isOld ? texts().measures.valueOld(value, ageText(shown.ageMs)) : value);
  }

  #drawCurve({ moment: { instantMs, robotNowMs }, windowMs }: TileFrame): void {
    const endMs = instantMs ?? robotNowMs;
    const described = this.#recorded();
    this.#windowS = windowMs / 1000;
    const range = described?.series.range(endMs - windowMs, endMs) ?? null;
    const said = texts().measures;
    setText(this.#least, said.least(range === null ? '–' : numberText(range.least, this.#unit)));
    setText(this.#most, said.most(range === null ? '–' : numberText(range.most, this.#unit)));
    if (described === undefined) return;
    described.series.curve(endMs - windowMs, endMs, this.#curve);
    this.#plot.setData([this.#curve.xs, this.#curve.ys]);
  }
}

/** @param windowS how far back the curve reaches now, s @param isStale whether it is drawn as stale */
function chartOptions(windowS: () => number, isStale: () => boolean): uPlot.Options {
  return {
    width: LEAST_WIDTH,
    height: HEIGHT,
    padding: [6, 16, 0, 0],
    legend: { show: false },
    cursor: { show: false },
    select: { show: false } as uPlot.Select,
    scales: {
      x: { time: false, range: () => [-windowS(), 0] },
      y: { range: (_, low, high) => padded(low, high) },
    },
    axes: [
      {
        stroke: quiet,
        grid: GRID,
        ticks: TICKS,
        font: FONT,
        size: 26,
        space: 60,
        values: (_, splits) => splits.map((at) => (at === 0 ? texts().measures.now : `−${spanWords(-at)}`)),
        incrs: [5, 10, 30, 60, 120, 300, 600, 1200],
      },
      {
        stroke: quiet,
        grid: GRID,
        ticks: TICKS,
        font: FONT,
        size: AXIS_WIDTH,
        space: 26,
        values: (_, splits) => splits.map((at) => marked(String(Number(at.toPrecision(6))))),
      },
    ],
    series: [
      {},
      {
        stroke: () => (isStale() ? palette.stale : palette.good),
        width: 1.5,
        points: { show: false },
        spanGaps: false,
      },
    ],
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
