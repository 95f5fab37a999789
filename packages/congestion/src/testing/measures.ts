import { BitRate, bitsOfBytes } from '@farpoint/timing';
import { BIN_MS, type FlowRecord, sumBins } from './flow-record.ts';
import { carriedAtMost, type Outcome } from './scenario.ts';

/** Arrived bits as a fraction of what the link could carry between two times. */
export function utilisation({ scenario }: Outcome, flow: FlowRecord, fromMs: number, toMs: number): number {
  return bitsOfBytes(sumBins(flow.arrivedBytes, fromMs, toMs)) / carriedAtMost(scenario, fromMs, toMs);
}

/** Arrival rate, bit/s. */
export function throughput(flow: FlowRecord, fromMs: number, toMs: number): number {
  return BitRate.of(sumBins(flow.arrivedBytes, fromMs, toMs), toMs - fromMs);
}

/** The first flow's fraction of what both received. */
export function share(a: FlowRecord, b: FlowRecord, fromMs: number, toMs: number): number {
  const bytes = sumBins(a.arrivedBytes, fromMs, toMs);
  return bytes / (bytes + sumBins(b.arrivedBytes, fromMs, toMs));
}

/** Of the packets sent between two times, the fractions dropped by a full queue (`overflow`) and lost otherwise. */
export function losses(flow: FlowRecord, fromMs: number, toMs: number): { overflow: number; other: number } {
  const sent = Math.max(sumBins(flow.sentPackets, fromMs, toMs), 1);
  return {
    overflow: sumBins(flow.overflowed, fromMs, toMs) / sent,
    other: sumBins(flow.lost, fromMs, toMs) / sent,
  };
}

/** Quantiles of the queueing time of the packets that were sent between two times and arrived, ms. */
export function queueQuantiles(
  flow: FlowRecord,
  fromMs: number,
  toMs: number,
  at: readonly number[],
): number[] {
  return quantiles(flow.queueMs, flow, fromMs, toMs, at);
}

/**
 * How long packets that waited for more than `limitMs` kept arriving, ms: the sum of the gaps below 100 ms between such
 * arrivals.
 */
export function msAboveQueue(flow: FlowRecord, limitMs: number, fromMs: number, toMs: number): number {
  let sum = 0;
  let lastArrival = Number.NaN;
  let lastAbove = false;
  for (let i = 0; i < flow.packetMs.length; i++) {
    const sent = flow.packetMs[i] as number;
    if (sent < fromMs - 1000 || sent >= toMs) continue;
    const waited = flow.queueMs[i] as number;
    const leaves = sent + waited;
    const above = waited > limitMs;
    if (leaves >= fromMs && above && lastAbove) sum += leaves - lastArrival;
    lastArrival = leaves;
    lastAbove = above;
  }
  return sum;
}

/** Time from `fromMs` until the flow first fills `part` of the link over a whole window of 500 ms; NaN for never. */
export function msUntilUsed(
  outcome: Outcome,
  flow: FlowRecord,
  fromMs: number,
  toMs: number,
  part = 0.9,
): number {
  const windowMs = 500;
  for (let at = fromMs; at + windowMs <= toMs; at += BIN_MS)
    if (utilisation(outcome, flow, at, at + windowMs) >= part) return at + windowMs - fromMs;
  return Number.NaN;
}

function quantiles(
  values: readonly number[],
  flow: FlowRecord,
  fromMs: number,
  toMs: number,
  at: readonly number[],
): number[] {
  const picked: number[] = [];
  for (let i = 0; i < values.length; i++) {
    const sent = flow.packetMs[i] as number;
    const value = values[i] as number;
    if (sent >= fromMs && sent < toMs) picked.push(value);
  }
  const sorted = Float64Array.from(picked).sort();
  return at.map((q) => sorted[Math.min(Math.floor(q * sorted.length), sorted.length - 1)] ?? Number.NaN);
}
