/** `pnpm bench congestion`: rate controllers on simulated links. */

import { readFileSync, writeFileSync } from 'node:fs';
import { AdaptiveRateController, FixedRateController, type RateController } from '@farpoint/congestion';
import {
  type FlowRecord,
  losses,
  msAboveQueue,
  msUntilUsed,
  type Outcome,
  queueQuantiles,
  runScenario,
  type Scenario,
  share,
  sumBins,
  throughput,
  utilisation,
} from '@farpoint/congestion/testing';
import { BUSY_COMPUTER, type CapacityStep, parseTrace } from '@farpoint/network-sim';
import { BitRate } from '@farpoint/timing';
import { benchOptions, option } from './bench-options.ts';
import { GccController } from './gcc/gcc-controller.ts';
import { type Panel, renderChart, type Series } from './plot/chart.ts';
import { type Bench, type Cell, printJson, printTable } from './report.ts';

const USAGE = `pnpm bench congestion [--controller NAME,…] [--scenario TEXT] [--trace FILE] [--seed 1] [--plot FILE.svg] [--json]

Runs rate controllers (adaptive: ours; gcc: Google congestion control; fixed: 40 Mbit/s, halved by loss) over simulated
links in virtual time: a 30 Hz source as large as the target allows, paced, with padding for probes; a drop-tail queue;
feedback every 50–62 ms. --trace adds a link from a CSV file \`time_s,capacity_mbps\`; --scenario runs the scenarios whose name
contains the text; --plot draws the step, and the trace if one is given.

used: share of the link's capacity that arrived, after 5 s. queue: waiting time of the packets sent after 5 s. overflow: share
of the sent packets that the full queue dropped. until90: from the start (or the last rise) until 90 % of the link is used over
0.5 s. above100: how long after the fall packets still arrive that waited more than 100 ms. share: of what both flows got.`;

const LINK = BitRate.fromMbps(41.44);
const CONTROLLERS: Record<string, () => RateController> = {
  adaptive: () => new AdaptiveRateController(),
  gcc: () => new GccController(),
  fixed: () => new FixedRateController({ bitsPerSecond: BitRate.fromMbps(40) }),
};
/** The outcomes of one scenario that are plotted, one per controller. */
type Runs = Map<string, Outcome>;

interface Case extends Scenario {
  fallMs?: number;
  riseMs?: number;
}

const flat = (bitsPerSecond: number): CapacityStep[] => [{ atMs: 0, mbps: BitRate.toMbps(bitsPerSecond) }];
const BASE = { durationMs: 30_000, capacity: flat(LINK), rttMs: 42.4, queueMs: 100 };
const TCP = { ...BASE, durationMs: 60_000, capacity: flat(BitRate.fromMbps(20)), cubic: [{ startMs: 5000 }] };

const STEP: CapacityStep[] = [
  ...flat(LINK),
  { atMs: 15_000, mbps: 8 },
  { atMs: 28_000, mbps: BitRate.toMbps(LINK) },
];

const CASES: readonly Case[] = [
  { ...BASE, name: 'steady 41.44 Mbit/s' },
  { ...BASE, name: 'steady 8 Mbit/s', capacity: flat(BitRate.fromMbps(8)) },
  {
    ...BASE,
    name: 'step 41.44–8–41.44 Mbit/s',
    durationMs: 40_000,
    capacity: STEP,
    fallMs: 15_000,
    riseMs: 28_000,
  },
  { ...BASE, name: 'queue of 10 ms', queueMs: 10 },
  { ...BASE, name: '5 % loss', loss: 0.05 },
  { ...BASE, name: '20 % loss', loss: 0.2 },
  {
    ...BASE,
    name: 'bursts of loss',
    burstLoss: { enter: 0.002, leave: 0.05, lossWhenBad: 0.8, lossWhenGood: 0 },
  },
  { ...BASE, name: 'jitter of 3 ms', tailMs: 3 },
  { ...BASE, name: 'delay that wobbles by ± 5 ms', jitterMs: 5 },
  { ...BASE, name: 'another route, longer by 16 ms', durationMs: 30_000, delaySteps: [[6000, 16]] },
  { ...BASE, name: '20 % of feedback lost', backLoss: 0.2 },
  { ...BASE, name: 'a busy computer', stalls: BUSY_COMPUTER },
  { ...BASE, name: 'a busy computer, 5 % loss', stalls: BUSY_COMPUTER, loss: 0.05 },
  {
    ...BASE,
    name: 'a busy computer, 41.44–8–41.44 Mbit/s',
    stalls: BUSY_COMPUTER,
    durationMs: 40_000,
    capacity: STEP,
    fallMs: 15_000,
    riseMs: 28_000,
  },
  {
    ...BASE,
    name: 'a link that stalls for 5–25 ms, 4 / s',
    stalls: { link: { perSecond: 4, lengthMs: [5, 25] } },
  },
  {
    ...BASE,
    name: 'a sender that stalls for 5–40 ms, 5 / s',
    stalls: { sender: { perSecond: 5, lengthMs: [5, 40] } },
  },
  {
    ...BASE,
    name: 'outage of 10 s',
    durationMs: 40_000,
    capacity: [...flat(LINK), { atMs: 15_000, mbps: 0 }, { atMs: 25_000, mbps: BitRate.toMbps(LINK) }],
    riseMs: 25_000,
  },
  { ...TCP, name: 'CUBIC, 20 Mbit/s, queue 50 ms', queueMs: 50 },
  { ...TCP, name: 'CUBIC, 20 Mbit/s, queue 100 ms' },
  { ...TCP, name: 'CUBIC, 20 Mbit/s, queue 200 ms', queueMs: 200 },
  { ...TCP, name: 'CUBIC, 20 Mbit/s, queue 100 ms, a busy computer', stalls: BUSY_COMPUTER },
  { ...BASE, name: 'two of the same', durationMs: 60_000, media: [{}, { startMs: 10_000 }] },
];

export const bench: Bench = {
  name: 'congestion',
  summary: 'rate controllers on simulated links: use, queue, loss, recovery, share beside TCP',
  usage: USAGE,
  async run(argv) {
    const { controller, scenario, trace, seed, plot, json } = benchOptions(argv, {
      controller: option.list(
        ['adaptive', 'gcc', 'fixed'],
        option.choice(undefined, Object.keys(CONTROLLERS)),
      ),
      scenario: option.text(''),
      trace: option.text(),
      seed: option.number(1),
      plot: option.text(),
    });
    const traced = trace === undefined ? [] : [traceCase(trace)];
    const cases = [...CASES, ...traced].filter(({ name }) => name.includes(scenario));
    const results: Record<string, unknown>[] = [];
    const plots: Panel[] = [];
    for (const one of cases) {
      const runs: Runs = new Map();
      for (const name of controller) {
        const outcome = runScenario({ ...one, seed }, CONTROLLERS[name] as () => RateController);
        runs.set(name, outcome);
        results.push({ scenario: one.name, controller: name, ...measure(one, outcome) });
      }
      if (one.fallMs !== undefined || traced.includes(one)) plots.push(...panels(one, runs));
    }
    printTable(
      [
        'scenario',
        'controller',
        'used',
        'queue p50',
        'p95 ms',
        'overflow %',
        'until90 s',
        'above100 ms',
        'share',
      ],
      results.map((row) => Object.values(row) as Cell[]),
    );
    if (plot !== undefined) {
      const title = 'Rate controllers on simulated links';
      writeFileSync(plot, renderChart({ title, panels: plots, columns: 2, panelWidth: 560 }));
    }
    if (json) printJson({ bench: 'congestion', seed, results });
  },
};

function measure(one: Case, outcome: Outcome): Record<string, Cell> {
  const { durationMs } = one;
  const [flow, second] = outcome.media as [FlowRecord, FlowRecord | undefined];
  const other = outcome.cubic[0] ?? second;
  const [p50, p95] = queueQuantiles(flow, 5000, durationMs, [0.5, 0.95]) as [number, number];
  const together = second === undefined ? 0 : utilisation(outcome, second, 5000, durationMs);
  const round = (value: number, digits: number) =>
    Number.isNaN(value) ? null : Number(value.toFixed(digits));
  return {
    used: round(utilisation(outcome, flow, 5000, durationMs) + together, 3),
    queueMsP50: round(p50, 1),
    queueMsP95: round(p95, 1),
    overflowPercent: round(100 * losses(flow, 0, durationMs).overflow, 2),
    secondsUntil90: round(msUntilUsed(outcome, flow, one.riseMs ?? 0, durationMs) / 1000, 1),
    msAbove100:
      one.fallMs === undefined
        ? null
        : round(msAboveQueue(flow, 100, one.fallMs, one.riseMs ?? durationMs), 0),
    share: other === undefined ? null : round(share(flow, other, 15_000, durationMs), 2),
  };
}

/** Two panels: rates above, queueing delay below. */
function panels(one: Case, runs: Runs): Panel[] {
  const seconds = (steps: readonly CapacityStep[]) =>
    [...steps.map((s) => s.atMs), one.durationMs].map((t) => t / 1000);
  const capacity = one.capacity.map((s) => s.mbps);
  const rates: Series[] = [
    { label: 'link', x: seconds(one.capacity), y: [...capacity, capacity.at(-1) ?? 0], shape: 'area' },
  ];
  const queues: Series[] = [];
  const bin = 200;
  const times = Array.from({ length: Math.floor(one.durationMs / bin) }, (_, i) => i * bin);
  for (const [label, outcome] of runs) {
    const flow = outcome.media[0] as FlowRecord;
    const x = times.map((t) => t / 1000);
    rates.push({ label, x, y: times.map((t) => BitRate.toMbps(throughput(flow, t, t + bin))) });
    queues.push({ label, x, y: times.map((t) => mostWaited(flow, t, t + bin)) });
  }
  const axis = { xLabel: 'time (s)' };
  return [
    {
      ...axis,
      title: one.name,
      yLabel: 'arriving (Mbit/s)',
      series: rates,
      yRange: [0, 1.6 * Math.max(...capacity)],
    },
    { ...axis, title: one.name, yLabel: 'longest wait in the queue (ms)', series: queues, yRange: [0, 600] },
  ];
}

function mostWaited(flow: FlowRecord, fromMs: number, toMs: number): number {
  if (sumBins(flow.sentPackets, fromMs, toMs) === 0) return Number.NaN;
  return Math.min(queueQuantiles(flow, fromMs, toMs, [1])[0] ?? Number.NaN, 10_000);
}

function traceCase(file: string): Case {
  const { steps: capacity } = parseTrace(readFileSync(file, 'utf8'), 'hold');
  // A cellular base station has a long queue for each user.
  return {
    name: `trace ${file.split('/').at(-1)}`,
    durationMs: capacity.at(-1)!.atMs,
    capacity,
    rttMs: 42.4,
    queueBytes: 500_000,
  };
}
