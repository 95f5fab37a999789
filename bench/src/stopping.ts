/** `pnpm bench stopping`: the way to standing still, over latency and speed. */
import { writeFile } from 'node:fs/promises';
import { benchOptions, option } from './bench-options.ts';
import { type Panel, renderChart, type Series } from './plot/chart.ts';
import { type Bench, printJson, printTable } from './report.ts';
import { feltMs, type StopCause, stopCauses, worstStop } from './stopping-run.ts';

const USAGE = `pnpm bench stopping [--plot FILE.svg] [--json]

In simulated time: a robot is driven straight ahead over a link of constant latency until something happens, at the worst
instant between two pictures (30 a second). Measures the way from then until it stands: with the bounds on the age of the
view and on blind travel, and with the watchdog alone, as most teleoperated robots have it.`;

const INTERVAL_MS = 1000 / 30;
const LATENCIES_MS = [20, 50, 100, 150, 200, 300, 400, 600, 800, 1000];
const SPEEDS_MPS = [0.25, 0.5, 1, 1.5];
/** The speed of the table, m/s. */
const SHOWN_MPS = 1;

const TITLES: Record<StopCause, string> = {
  sight: 'something appears: the driver presses STOP at once',
  link: 'the link is cut',
  camera: 'the camera dies',
  page: 'the page freezes, and the driver holds on',
};

interface Row {
  cause: StopCause;
  askedMps: number;
  latencyMs: number;
  bounded: boolean;
  drivenMps: number;
  brakesMs: number | null;
  metres: number;
}

function measure(cause: StopCause, askedMps: number, latencyMs: number, bounded: boolean): Row {
  const stop = worstStop({ cause, askedMps, latencyMs, intervalMs: INTERVAL_MS, bounded });
  const { drivenMps, brakesMs, metres } = stop;
  return { cause, askedMps, latencyMs, bounded, drivenMps, brakesMs, metres };
}

/** Without bounds, nothing but the end of the link stops a robot whose driver holds on. */
const endsUnbounded = (cause: StopCause) => cause === 'sight' || cause === 'link';

function seriesOf(rows: readonly Row[], label: string, dashed: boolean): Series {
  return {
    label,
    dashed,
    x: rows.map(({ latencyMs }) => latencyMs),
    y: rows.map(({ metres }) => metres),
  };
}

function panelOf(cause: StopCause, rows: readonly Row[]): Panel {
  const of = (mps: number, bounded: boolean) =>
    rows.filter((row) => row.cause === cause && row.askedMps === mps && row.bounded === bounded);
  return {
    title: TITLES[cause],
    xLabel: 'latency from camera to eye and from hand to robot, in sum, ms',
    yLabel: 'way to standing still, m',
    series: [
      ...SPEEDS_MPS.map((mps) => seriesOf(of(mps, true), `${mps} m/s`, false)),
      ...(endsUnbounded(cause)
        ? [{ ...seriesOf(of(SHOWN_MPS, false), `${SHOWN_MPS} m/s, watchdog alone`, true), colour: '#000000' }]
        : []),
    ],
    yRange: [0, 1.4],
  };
}

export const bench: Bench = {
  name: 'stopping',
  summary: 'the way to standing still over latency and speed, in simulated time, as a plot',
  usage: USAGE,
  async run(argv) {
    const { plot, json } = benchOptions(argv, { plot: option.text() });
    const rows = stopCauses.flatMap((cause) =>
      LATENCIES_MS.flatMap((latencyMs) => [
        ...SPEEDS_MPS.map((mps) => measure(cause, mps, latencyMs, true)),
        ...(endsUnbounded(cause) ? [measure(cause, SHOWN_MPS, latencyMs, false)] : []),
      ]),
    );
    printTable(
      ['what happens', 'latency, ms', 'bounds', 'driven, m/s', 'braking after, ms', 'way, m'],
      rows
        .filter(({ askedMps }) => askedMps === SHOWN_MPS)
        .map(({ cause, latencyMs, bounded, drivenMps, brakesMs, metres }) => [
          cause,
          latencyMs,
          bounded ? 'all' : 'watchdog',
          drivenMps,
          brakesMs,
          metres,
        ]),
    );
    const felt = [0.5, 1, 1.5].map((mps) => ({ mps, ...feltMs(mps) }));
    for (const { mps, ramped, plain } of felt) {
      console.log(`to half of ${mps} m/s: ${ramped} ms with the supervisor's ramps, ${plain} ms without`);
    }
    if (plot !== undefined) {
      const svg = renderChart({
        title: 'How far a robot goes',
        subtitle:
          'worst instant between two of 30 pictures a second; simulated base, braking at 2 m/s², or 4 m/s² when it must',
        columns: 2,
        panelWidth: 560,
        panelHeight: 300,
        panels: stopCauses.map((cause) => panelOf(cause, rows)),
      });
      await writeFile(plot, svg);
    }
    if (json) printJson({ rows, felt });
  },
};
