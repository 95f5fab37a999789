import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { PicturePlanner, pictureAllowance } from './picture-plan.ts';

const policy = { perSecond: 10, longestSide: 640, quality: 70, share: 0.15 };

describe('pictureAllowance', () => {
  it('is zero on a poor path, the full share on a good one, and never more than data channels carry', () => {
    expect(pictureAllowance(0.5e6, 0.15)).toBe(0);
    expect(pictureAllowance(1e6, 0.15) / 1e6).toBeLessThan(0.03);
    expect(pictureAllowance(4e6, 0.15)).toBe(0.6e6);
    expect(pictureAllowance(10e6, 0.15)).toBe(1.5e6);
    expect(pictureAllowance(500e6, 0.15)).toBe(3e6);
  });

  it('never falls as the path’s rate grows, and stays within the share', () => {
    const rate = fc.double({ min: 0, max: 1e9, noNaN: true });
    fc.assert(
      fc.property(rate, rate, fc.double({ min: 0.01, max: 0.5, noNaN: true }), (a, b, share) => {
        const [low, high] = [Math.min(a, b), Math.max(a, b)];
        expect(pictureAllowance(low, share)).toBeLessThanOrEqual(pictureAllowance(high, share));
        expect(pictureAllowance(a, share)).toBeLessThanOrEqual(a * share);
      }),
    );
  });
});

describe('PicturePlanner', () => {
  it('plans full size and rate if there is room', () => {
    const planner = new PicturePlanner(policy);
    planner.onMade(20_000, 640);
    expect(planner.plan(3e6)).toMatchObject({ perSecond: 10, longestSide: 640, quality: 70 });
  });

  it('first plans fewer pictures, then smaller ones, and stops without a share', () => {
    const planner = new PicturePlanner(policy);
    planner.onMade(30_000, 640);
    expect(planner.plan(1e6)).toMatchObject({ longestSide: 640 });
    expect(planner.plan(1e6).perSecond).toBeCloseTo(3.79, 1);
    expect(planner.plan(0.4e6)).toMatchObject({ longestSide: 320 });
    expect(planner.plan(0.05e6)).toMatchObject({ longestSide: 160 });
    expect(planner.plan(0).perSecond).toBe(0);
  });

  it('does not alternate between two sizes', () => {
    const planner = new PicturePlanner(policy);
    planner.onMade(30_000, 640);
    const sides = [0.6, 0.5, 0.6, 0.5, 0.7].map((mbps) => planner.plan(mbps * 1e6).longestSide);
    expect(sides).toEqual([640, 320, 320, 320, 320]);
    expect(planner.plan(0.9e6).longestSide).toBe(640);
  });

  it('never plans more bytes than are available', () => {
    fc.assert(
      fc.property(
        fc.integer({ min: 500, max: 600_000 }),
        fc.array(fc.integer({ min: 1000, max: 3_000_000 }), { minLength: 1, maxLength: 20 }),
        (bytes, rates) => {
          const planner = new PicturePlanner(policy);
          planner.onMade(bytes, 640);
          for (const rate of rates) {
            const { perSecond, longestSide } = planner.plan(rate);
            expect(perSecond * bytes * (longestSide / 640) ** 1.5 * 8).toBeLessThanOrEqual(rate);
            expect(perSecond).toBeLessThanOrEqual(10);
          }
        },
      ),
    );
  });
});
