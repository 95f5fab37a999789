import { expect, test } from 'vitest';
import { constantCapacity } from './capacity.ts';
import { CubicWindow, RenoWindow } from './congestion-window.ts';
import type { CrossFlow } from './cross-flow.ts';
import { LinkModel } from './link-model.ts';
import type { LinkBin } from './link-statistics.ts';
import { idealProfile, type LinkProfile } from './profile.ts';
import { TcpFlow, type TcpFlowOptions } from './tcp-flow.ts';

const RTT = 40;
const base: LinkProfile = {
  ...idealProfile,
  capacity: constantCapacity(20),
  delayMs: RTT / 2,
  queue: { ms: RTT },
};

function tcp(more: Partial<TcpFlowOptions> = {}): TcpFlow {
  return new TcpFlow({ congestionControl: 'cubic', startMs: 0, ackDelayMs: RTT / 2, ...more });
}

function run(flows: readonly CrossFlow[], untilMs: number, profile: LinkProfile = base): LinkBin[] {
  const bins: LinkBin[] = [];
  const model = new LinkModel({
    profile,
    seed: 1,
    startMs: 0,
    sink: { delivered: () => {}, duplicated: () => {} },
    crossFlows: flows,
    onBin: (bin) => bins.push(bin),
  });
  model.advance(untilMs);
  return bins;
}

/** Mbit/s. */
const rate = (bins: readonly LinkBin[]) =>
  bins.reduce((sum, bin) => sum + bin.crossBytes, 0) / bins.length / 100 / 125;

test('slow start doubles the window each round trip', () => {
  const flow = tcp();
  const bins = run([flow], 3.9 * RTT, { ...base, capacity: constantCapacity(10_000), queue: { bytes: 1e9 } });
  expect(flow.window).toBeGreaterThanOrEqual(78);
  expect(flow.window).toBeLessThanOrEqual(80);
  expect(bins[0]?.crossBytes).toBe((10 + 20 + 40) * 1500);
});

test.each(['cubic', 'reno'] as const)(
  'one %s flow fills a link with a queue of one round trip',
  (congestionControl) => {
    const flow = tcp({ congestionControl });
    const bins = run([flow], 60_000);
    expect(rate(bins.slice(50))).toBeGreaterThan(19);
    expect(rate(bins.slice(50))).toBeLessThanOrEqual(20.01);
    expect(flow.reductions).toBeGreaterThan(3);
    expect(flow.reductions).toBeLessThan(100);
    expect(flow.timeouts).toBeLessThanOrEqual(1);
  },
);

test('two CUBIC flows that begin at different times converge to equal shares', () => {
  // The bins do not say which flow took which bytes: the second's share shows in its window.
  const first = tcp();
  const second = tcp({ startMs: 10_000 });
  const bins: number[] = [];
  const model = new LinkModel({
    profile: base,
    seed: 1,
    startMs: 0,
    sink: { delivered: () => {}, duplicated: () => {} },
    crossFlows: [first, second],
  });
  for (let ms = 60_000; ms < 120_000; ms += 100) {
    model.advance(ms);
    bins.push(second.window / (first.window + second.window));
  }
  const share = bins.reduce((sum, value) => sum + value, 0) / bins.length;
  expect(share).toBeGreaterThan(0.35);
  expect(share).toBeLessThan(0.65);
});

test('random loss holds Reno to the square-root law', () => {
  const loss = 0.001;
  const profile = { ...base, capacity: constantCapacity(1000), queue: { bytes: 1e9 }, loss };
  const bins = run([tcp({ congestionControl: 'reno' })], 300_000, profile);
  // Mathis et al. 1997: MSS / RTT × sqrt(3/2 / p), every segment acknowledged.
  const law = ((1500 * 8) / (RTT * 1000)) * Math.sqrt(1.5 / loss);
  expect(rate(bins) / law).toBeGreaterThan(0.8);
  expect(rate(bins) / law).toBeLessThan(1.2);
});

test('after an outage the flow resumes by its time-out', () => {
  const flow = tcp();
  const capacity = { ...constantCapacity(20), outages: [{ startMs: 10_000, endMs: 15_000 }] };
  const bins = run([flow], 40_000, { ...base, capacity });
  expect(rate(bins.slice(101, 149))).toBe(0);
  expect(flow.timeouts).toBeGreaterThan(0);
  expect(rate(bins.slice(250))).toBeGreaterThan(18);
});

test('a flow that has ended sends nothing', () => {
  const bins = run([tcp({ endMs: 5000 })], 20_000);
  expect(rate(bins.slice(60))).toBe(0);
});

test('acknowledgements that arrive all at once let the window grow as much as others', () => {
  const flow = tcp();
  const send = () => true;
  flow.run(0, send);
  for (let segment = 0; segment < 10; segment++) flow.delivered(segment, 20);
  flow.run(40, send);
  expect(flow.window).toBe(20);
});

test('a flow with limited data sends all of it, including replacements for losses, and then nothing', () => {
  const profile = { ...base, loss: 0.05, queue: { bytes: 30_000 } };
  const flow = tcp({ bytes: 1_000_000 });
  const bins = run([flow], 60_000, profile);
  const delivered = bins.reduce((sum, bin) => sum + bin.crossBytes, 0);
  expect(bins.some((bin) => bin.crossDrops > 0)).toBe(true);
  expect(delivered).toBeGreaterThanOrEqual(1_000_000);
  expect(delivered).toBeLessThan(1_100_000);
  expect(flow.nextMs).toBe(Number.POSITIVE_INFINITY);
});

test('CUBIC’s slow start ends when the round trips of a round have risen, before the queue overflows', () => {
  const window = new CubicWindow();
  const round = (rttMs: number) => {
    for (let left = Math.floor(window.segments); left > 0; left--) window.acknowledged(0, rttMs);
  };
  for (const rttMs of [40, 41, 42]) round(rttMs);
  expect(window.segments).toBe(80);
  // 5 ms (an eighth of 42) more than the round before.
  round(47.5);
  expect(window.segments).toBeLessThan(90);
  expect(window.segments).toBeGreaterThanOrEqual(88);

  const bins = run([tcp()], 2000, { ...base, queue: { ms: 200 } });
  expect(bins.every((bin) => bin.crossDrops === 0)).toBe(true);
  expect(rate(bins.slice(10))).toBeGreaterThan(15);
});

test('CUBIC keeps 0.7 of its window after a loss and is back at its plateau after K', () => {
  const window = new CubicWindow();
  while (window.segments < 100) window.acknowledged(0, RTT);
  window.lost();
  expect(window.segments).toBeCloseTo(70, 9);
  // RFC 9438: K = cbrt(W_max × (1 − 0.7) / 0.4) = 4.217 s. A long round trip keeps the Reno estimate below the curve.
  let nowMs = 0;
  const rttMs = 400;
  const at = (ms: number) => {
    while (nowMs < ms) {
      for (let i = 0; i < Math.floor(window.segments); i++) {
        window.acknowledged(nowMs, rttMs);
        nowMs += rttMs / window.segments;
      }
    }
    return window.segments;
  };
  expect(at(2000)).toBeGreaterThan(85);
  expect(at(4200)).toBeGreaterThan(97);
  expect(window.segments).toBeLessThan(104);
  expect(at(8400)).toBeGreaterThan(118);
});

test('Reno halves', () => {
  const window = new RenoWindow();
  while (window.segments < 50) window.acknowledged();
  window.lost();
  expect(window.segments).toBe(25);
  for (let i = 0; i < 25; i++) window.acknowledged();
  expect(window.segments).toBeCloseTo(26, 1);
  window.timedOut();
  expect(window.segments).toBe(1);
});
