import { describe, expect, it } from 'vitest';
import { planPoints } from './plan.ts';

const base = {
  targetBitsPerSecond: 40e6,
  framesPerSecond: 30,
  rawPoints: 230_400,
  overheadBytes: 68,
  floorFraction: 0.1,
  mostPoints: 1e6,
};
const wireBitsPerSecond = (points: number) =>
  (points / 150) * (16 + 1200 + 28 + 68) * 8 * base.framesPerSecond;

describe('planPoints', () => {
  it('fills the rate on the wire with whole packets, and not one more', () => {
    const points = planPoints(base);
    expect(points % 150).toBe(0);
    expect(wireBitsPerSecond(points)).toBeLessThanOrEqual(40e6);
    expect(wireBitsPerSecond(points + 150)).toBeGreaterThan(40e6);
  });

  it('sends no more than there is, and than is allowed', () => {
    expect(planPoints({ ...base, rawPoints: 1000 })).toBe(900);
    expect(planPoints({ ...base, mostPoints: 10_000 })).toBe(9900);
  });

  it('keeps the floor of 10 % of the raw cloud a second', () => {
    // 23,040 points a second, 768 a frame: five packets.
    expect(planPoints({ ...base, targetBitsPerSecond: 0 })).toBe(750);
    expect(planPoints({ ...base, targetBitsPerSecond: 0, floorFraction: 0 })).toBe(0);
  });
});
