import { describe, expect, it } from 'vitest';
import {
  BIN_MS,
  capacityRises,
  describeOutages,
  grown,
  type LinkBin,
  longestQueueAbove,
  outagesOf,
  queueQuantiles,
  shareOf,
  utilisationOf,
} from './link-analysis.ts';

/** Bins of 100 ms, starting at second 0. */
function bins(
  capacities: readonly number[],
  of: (capacity: number, i: number) => Partial<LinkBin> = () => ({}),
): LinkBin[] {
  return capacities.map((capacityMbps, i) => ({
    timeMs: i * BIN_MS,
    capacityMbps,
    offeredBytes: 0,
    deliveredBytes: 0,
    crossBytes: 0,
    deliveredPackets: 0,
    queueMsMean: 0,
    queueMsMax: 0,
    drops: {},
    ...of(capacityMbps, i),
  }));
}
const times = (count: number, value: number) => Array<number>(count).fill(value);
/** Bytes per bin at this rate. */
const bytes = (mbps: number) => (mbps * 1e6 * BIN_MS) / 8000;

describe('outagesOf', () => {
  it('counts brief service as part of an outage, and ignores brief silence', () => {
    const capacity = [
      ...times(20, 9),
      ...times(15, 0),
      1,
      1,
      ...times(15, 0.1),
      ...times(20, 9),
      ...times(10, 0),
      9,
    ];
    expect(outagesOf(bins(capacity))).toEqual([{ fromMs: 2000, toMs: 5200 }]);
  });
});

describe('utilisation and share', () => {
  it('are shares of the capacity, and of what left the link', () => {
    const run = bins(times(10, 20), () => ({ deliveredBytes: bytes(12), crossBytes: bytes(4) }));
    expect(utilisationOf(run)).toBeCloseTo(0.6);
    expect(shareOf(run)).toBeCloseTo(0.75);
  });
});

describe('queues', () => {
  it('weight each packet equally', () => {
    const run = bins(times(100, 20), (_, i) => ({
      deliveredPackets: i < 90 ? 10 : 1000,
      queueMsMean: i < 90 ? 1 : 50,
      queueMsMax: i < 90 ? 2 : 120,
    }));
    expect(queueQuantiles(run)).toEqual({ p50: 50, p95: 50, p99: 50, max: 120 });
    expect(longestQueueAbove(run, 100)).toBe(1000);
    expect(longestQueueAbove(run, 130)).toBe(0);
  });
});

describe('capacityRises', () => {
  it('finds a step even if one bin contains both rates, and the time to use it', () => {
    const capacity = [...times(50, 8), 30, ...times(80, 40)];
    const run = bins(capacity, (mbps, i) => ({ deliveredBytes: bytes(i < 71 ? 8 : 0.95 * mbps) }));
    const rises = capacityRises(run);
    expect(rises).toHaveLength(1);
    expect(rises[0]).toMatchObject({ fromMbps: 8, toMbps: 40 });
    expect(rises[0]?.recoverySeconds).toBeCloseTo(2.5, 1);
  });

  it('reports a new rate that was never used', () => {
    const run = bins([...times(50, 8), ...times(80, 40)], () => ({ deliveredBytes: bytes(8) }));
    expect(capacityRises(run).map(({ recoverySeconds }) => recoverySeconds)).toEqual([null]);
  });

  it('ignores a capacity that drifts', () => {
    expect(capacityRises(bins(Array.from({ length: 300 }, (_, i) => 10 + 8 * Math.sin(i / 7))))).toEqual([]);
  });
});

describe('describeOutages', () => {
  it('reports when the robot stopped and when points resumed, also in a new session', () => {
    const robot = [0, 100, 200, 300].map((timeMs) => ({ timeMs, speed: timeMs < 200 ? 0.4 : 0, turn: 0 }));
    const page = [0, 2000, 2100, 2200, 2300].map((timeMs, i) => ({
      timeMs,
      packetsReceived: [90, 90, 90, 0, 40][i] as number,
      ...{ packetsLost: 0, framesDrawn: 0, pointsDrawn: 0 },
      session: timeMs < 2200 ? 'waiting' : 'live',
      link: timeMs < 2200 ? 'lost' : 'live',
    }));
    expect(describeOutages([{ fromMs: 50, toMs: 2050 }], robot, page, 0)).toEqual([
      { startS: 0.1, endS: 2, stoppedAfterMs: 150, resumedAfterMs: 250, words: ['lost'] },
    ]);
  });
});

describe('grown', () => {
  it('adds up totals that restart', () => {
    expect(grown([5, 9, 2, 3])).toBe(7);
  });
});
