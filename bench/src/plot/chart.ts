/** Line charts with a common x axis, in rows of panels, as an SVG document. */
import { linearScale, type Scale, tickLabel } from './scale.ts';
import { element, escapeText, linePath } from './svg.ts';

export interface Series {
  label: string;
  /** Ascending x; NaN in y leaves a gap. */
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  /**
   * `line` (default); `step`: y holds until the next x; `area`: a filled step, for a reference; `points`: a dot at
   * each value.
   */
  shape?: 'line' | 'step' | 'area' | 'points';
  /** Default: the next colour of the palette; areas are grey. */
  colour?: string;
  dashed?: boolean;
}

/** A span of x to shade, such as an outage. */
export interface Span {
  from: number;
  to: number;
  label?: string;
}

export interface Panel {
  title?: string;
  xLabel: string;
  yLabel: string;
  series: readonly Series[];
  spans?: readonly Span[];
  /** Default: from the series; y starts at 0 unless values are negative. */
  xRange?: readonly [number, number];
  yRange?: readonly [number, number];
}

export interface Chart {
  title: string;
  /** Shown below the title: what was measured, and with which settings. */
  subtitle?: string;
  panels: readonly Panel[];
  /** Panels per row; default: all in one row. */
  columns?: number;
  /** Width of one panel in pixels. */
  panelWidth?: number;
  panelHeight?: number;
}

/** Okabe and Ito's palette, which is distinguishable with any kind of colour vision. */
export const PALETTE = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#000000'];
const AREA_COLOUR = '#d5d9de';
const INK = '#24292f';
const GRID = '#e4e7eb';
const MARGIN = { top: 30, right: 14, bottom: 46, left: 62 };
const HEADER = 62;
const LEGEND_ROW = 18;

/** @returns an SVG document with a white background, so that it is readable on dark pages, too */
export function renderChart(chart: Chart): string {
  const columns = chart.columns ?? chart.panels.length;
  const rows = Math.ceil(chart.panels.length / columns);
  const width = chart.panelWidth ?? 400;
  const height = chart.panelHeight ?? 300;
  const total = { width: columns * width, height: HEADER + rows * height };
  const panels = chart.panels.map((panel, i) =>
    element(
      'g',
      { transform: `translate(${(i % columns) * width} ${HEADER + Math.floor(i / columns) * height})` },
      renderPanel(panel, width, height),
    ),
  );
  const subtitle = element(
    'text',
    { x: 16, y: 46, 'font-size': 12, fill: '#57606a' },
    escapeText(chart.subtitle ?? ''),
  );
  return `${element(
    'svg',
    {
      xmlns: 'http://www.w3.org/2000/svg',
      width: total.width,
      height: total.height,
      viewBox: `0 0 ${total.width} ${total.height}`,
      'font-family': 'system-ui, -apple-system, Segoe UI, Roboto, sans-serif',
      fill: INK,
    },
    element('title', {}, escapeText(chart.title)),
    element('rect', { width: '100%', height: '100%', fill: '#ffffff' }),
    element('text', { x: 16, y: 26, 'font-size': 17, 'font-weight': 600 }, escapeText(chart.title)),
    subtitle,
    ...panels,
  )}\n`;
}

/** The part of a panel within its axes, pixels. */
interface Area {
  x: Scale;
  y: Scale;
  right: number;
  bottom: number;
}

function renderPanel(panel: Panel, width: number, height: number): string {
  const right = width - MARGIN.right;
  const bottom = height - MARGIN.bottom;
  const x = linearScale(
    panel.xRange ?? extent(panel.series.map((series) => series.x)),
    [MARGIN.left, right],
    8,
    true,
  );
  const [least, most] = extent(panel.series.map((series) => series.y));
  const y = linearScale(panel.yRange ?? [Math.min(0, least), most], [bottom, MARGIN.top], 6);
  const area: Area = { x, y, right, bottom };
  const colours = coloursOf(panel.series);
  return [
    ...(panel.spans ?? []).map((span) => renderSpan(span, area)),
    ...y.ticks().map((tick) => renderYTick(tick, area)),
    ...x.ticks().map((tick) => renderXTick(tick, area)),
    renderTitles(panel, area, height),
    ...panel.series.map((series, i) =>
      renderSeries(series, colours[i] as string, x.pixel, y.pixel, y.pixel(Math.max(0, y.low))),
    ),
    renderLegend(panel.series, colours, right),
  ].join('');
}

function renderSpan(span: Span, { x, bottom }: Area): string {
  const [from, to] = [x.pixel(Math.max(span.from, x.low)), x.pixel(Math.min(span.to, x.high))];
  const shade = element('rect', {
    x: from,
    y: MARGIN.top,
    width: to - from,
    height: bottom - MARGIN.top,
    fill: '#fff1e5',
  });
  if (span.label === undefined) return shade;
  return shade + element('text', { x: from + 3, y: bottom - 5, 'font-size': 10 }, escapeText(span.label));
}

/** Renders the label, and a line across the panel. */
function renderYTick(tick: number, { y, right }: Area): string {
  const at = y.pixel(tick);
  const line = element('path', {
    d: linePath([
      [MARGIN.left, at],
      [right, at],
    ]),
    stroke: tick === 0 ? INK : GRID,
  });
  const text = { x: MARGIN.left - 7, y: at + 4, 'font-size': 11, 'text-anchor': 'end' };
  return line + element('text', text, tickLabel(tick));
}

function renderXTick(tick: number, { x, bottom }: Area): string {
  const at = x.pixel(tick);
  const line = element('path', {
    d: linePath([
      [at, bottom],
      [at, bottom + 4],
    ]),
    stroke: INK,
  });
  const text = { x: at, y: bottom + 17, 'font-size': 11, 'text-anchor': 'middle' };
  return line + element('text', text, tickLabel(tick));
}

/** Renders the labels of the axes, and the panel's title. */
function renderTitles(panel: Panel, { right, bottom }: Area, height: number): string {
  const middle = (MARGIN.top + bottom) / 2;
  const axisText = { 'font-size': 12, 'text-anchor': 'middle' };
  const x = { x: (MARGIN.left + right) / 2, y: height - 10, ...axisText };
  const y = { transform: `translate(14 ${middle}) rotate(-90)`, ...axisText };
  const axes = element('text', x, escapeText(panel.xLabel)) + element('text', y, escapeText(panel.yLabel));
  if (panel.title === undefined) return axes;
  const at = { x: MARGIN.left, y: 18, 'font-size': 13, 'font-weight': 600 };
  return axes + element('text', at, escapeText(panel.title));
}

/** A colour for each series: its own, or the next of the palette. */
function coloursOf(series: readonly Series[]): string[] {
  let next = 0;
  return series.map(({ colour, shape }) => {
    if (colour !== undefined) return colour;
    return shape === 'area' ? AREA_COLOUR : (PALETTE[next++ % PALETTE.length] as string);
  });
}

function renderSeries(
  series: Series,
  colour: string,
  xPixel: (value: number) => number,
  yPixel: (value: number) => number,
  ground: number,
): string {
  const points: [number, number][] = [];
  for (let i = 0; i < series.x.length; i++) {
    const at = xPixel(series.x[i] as number);
    const before = points.at(-1);
    if ((series.shape === 'step' || series.shape === 'area') && before !== undefined)
      points.push([at, before[1]]);
    points.push([at, yPixel(series.y[i] as number)]);
  }
  if (series.shape === 'area') {
    const [first, last] = [points[0]?.[0] ?? 0, points.at(-1)?.[0] ?? 0];
    const outline = [[first, ground], ...points, [last, ground]] as [number, number][];
    return element('path', { d: `${linePath(outline)}Z`, fill: colour, stroke: 'none' });
  }
  if (series.shape === 'points') {
    const dots = points.filter(([, y]) => Number.isFinite(y));
    return dots.map(([cx, cy]) => element('circle', { cx, cy, r: 3.5, fill: colour })).join('');
  }
  const dash = series.dashed ? '5 4' : undefined;
  const line = { fill: 'none', stroke: colour, 'stroke-width': 1.8, 'stroke-linejoin': 'round' };
  return element('path', { d: linePath(points), ...line, 'stroke-dasharray': dash });
}

/** In the upper right, where most curves are low; with a background for those that are not. */
function renderLegend(series: readonly Series[], colours: readonly string[], right: number): string {
  const longest = Math.max(0, ...series.map((one) => one.label.length));
  const width = 34 + longest * 6.4;
  const left = right - width;
  const top = MARGIN.top + 4;
  const rows = series.flatMap((one, i) => {
    const middle = top + 13 + i * LEGEND_ROW;
    const swatch =
      one.shape === 'area'
        ? element('rect', { x: left + 6, y: middle - 5, width: 18, height: 10, fill: colours[i] })
        : element('path', {
            d: linePath([
              [left + 6, middle],
              [left + 24, middle],
            ]),
            stroke: colours[i],
            'stroke-width': 2.4,
            'stroke-dasharray': one.dashed ? '5 4' : undefined,
          });
    return [swatch, element('text', { x: left + 30, y: middle + 4, 'font-size': 11 }, escapeText(one.label))];
  });
  const ground = {
    x: left,
    y: top,
    width,
    height: series.length * LEGEND_ROW + 8,
    fill: '#ffffff',
    opacity: 0.85,
  };
  return element('g', {}, element('rect', ground), ...rows);
}

function extent(columns: readonly ArrayLike<number>[]): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const values of columns) {
    for (let i = 0; i < values.length; i++) {
      const value = values[i] as number;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return low <= high ? [low, high] : [0, 1];
}
