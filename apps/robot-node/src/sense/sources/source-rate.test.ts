import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { SourceRate } from './source-rate.ts';

/** The rate after clouds at these intervals. */
function after(...intervals: number[]): number | null {
  const rate = new SourceRate();
  let nowMs = 5000;
  rate.came(nowMs);
  for (const interval of intervals) {
    nowMs += interval;
    rate.came(nowMs);
  }
  return rate.perSecond;
}
const times = (count: number, interval: number) => Array.from({ length: count }, () => interval);

describe('SourceRate', () => {
  it('is not known before the fourth cloud', () => {
    expect(after()).toBeNull();
    expect(after(100, 100)).toBeNull();
    expect(after(100, 100, 100)).toBe(10);
  });

  it('follows a change within eight clouds', () => {
    expect(after(...times(20, 200), ...times(8, 50))).toBe(20);
    expect(after(...times(20, 50), ...times(8, 200))).toBe(5);
  });

  it('is not misled by a pause', () => {
    expect(after(...times(8, 100), 60_000)).toBe(10);
    expect(after(60_000, 100, 100)).toBe(10);
    expect(after(...times(8, 100), 1500, ...times(7, 100))).toBe(10);
  });

  it('is at least 0.5 clouds a second, and unknown where clouds come all at once', () => {
    expect(after(...times(8, 10_000))).toBe(0.5);
    expect(after(0, 0, 0)).toBeNull();
  });

  it('is within 10 % of a rate whose clouds are up to a sixth of the interval early or late', () => {
    const jitters = fc.array(fc.double({ min: -1 / 6, max: 1 / 6, noNaN: true }), {
      minLength: 9,
      maxLength: 60,
    });
    fc.assert(
      fc.property(fc.integer({ min: 2, max: 120 }), jitters, (perSecond, jitter) => {
        const rate = new SourceRate();
        for (const [k, early] of jitter.entries()) rate.came(((k + 1 + early) * 1000) / perSecond);
        expect(Math.abs((rate.perSecond ?? 0) / perSecond - 1)).toBeLessThan(0.1);
      }),
    );
  });
});
