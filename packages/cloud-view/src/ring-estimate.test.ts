import { longProperty } from '@farpoint/network-sim/cases';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { RingEstimator } from './ring-estimate.ts';

const DEGREE = Math.PI / 180;

/** Reproducible numbers in [0, 1): Marsaglia's xorshift, 32 bits. */
function numbers(seed: number): () => number {
  let state = seed >>> 0 || 1;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) / 0x1_0000_0000;
  };
}

/** Approximately normal, deviation 1. */
const gaussian = (next: () => number) => (next() + next() + next() + next() - 2) * Math.sqrt(3);

/** Adds points of rings; each ring is hit with the share of its own. @param noise of an elevation, radians */
function scan(rings: readonly number[], shares: readonly number[], count: number, noise: number, seed = 7) {
  const estimator = new RingEstimator();
  const next = numbers(seed);
  for (let added = 0; added < count; ) {
    const ring = Math.floor(next() * rings.length);
    if (next() > shares[ring]!) continue;
    estimator.add(rings[ring]! + gaussian(next) * noise);
    added++;
  }
  return estimator;
}

function even(count: number, from: number, to: number): number[] {
  return Array.from({ length: count }, (_, i) => (from + ((to - from) * i) / (count - 1)) * DEGREE);
}

function expectRings(found: readonly number[] | null, rings: readonly number[]): void {
  expect(found).toHaveLength(rings.length);
  const gap = Math.min(...rings.slice(1).map((ring, i) => ring - rings[i]!));
  for (const [i, ring] of rings.entries()) expect(Math.abs(found![i]! - ring)).toBeLessThan(gap / 5);
}

/** Elevations of the beams of a LiDAR whose beams crowd near the horizon, degrees. */
const CROWDED = [
  -25, -15.6, -11.3, -8.8, -7.2, -6.1, -5.3, -4.7, -4, -3.3, -2.7, -2, -1.3, -0.7, 0, 0.7, 1.3, 2.3, 3.3, 4.7,
  7, 10.3, 15,
];

describe('RingEstimator', () => {
  test.each([
    ['16 rings, 2° apart', even(16, -15, 15), 0.15],
    ['32 rings, 1.3° apart', even(32, -30.67, 10.67), 0.1],
    ['64 rings, 0.7° apart', even(64, -22.5, 22.5), 0.06],
    ['rings that crowd near the horizon', CROWDED.map((each) => each * DEGREE), 0.05],
  ])('finds %s', (_, rings, noise) => {
    const { elevations } = scan(
      rings,
      rings.map(() => 1),
      20_000,
      noise * DEGREE,
    );
    expectRings(elevations, rings);
  });

  test('finds rings of any number and place, although some hit little', () => {
    fc.assert(
      fc.property(
        fc.integer({ min: 4, max: 48 }),
        fc.double({ min: 1, max: 1.8, noNaN: true }),
        fc.double({ min: -30, max: -5, noNaN: true }),
        fc.integer({ min: 1, max: 1e9 }),
        (count, gap, lowest, seed) => {
          const rings = even(count, lowest, lowest + gap * (count - 1));
          const next = numbers(seed);
          const shares = rings.map(() => 0.25 + 0.75 * next());
          expectRings(scan(rings, shares, 20_000, 0.08 * DEGREE, seed).elevations, rings);
        },
      ),
      longProperty(8, 40),
    );
  });

  test('finds none where there are none', () => {
    fc.assert(
      fc.property(fc.integer({ min: 1, max: 1e9 }), fc.integer({ min: 5, max: 90 }), (seed, width) => {
        const estimator = new RingEstimator();
        const next = numbers(seed);
        // Evenly, and as of a floor and a wall that are seen by a camera.
        for (let i = 0; i < 20_000; i++) estimator.add((next() - 0.5) * width * DEGREE);
        expect(estimator.elevations).toBeNull();
        estimator.reset();
        for (let i = 0; i < 20_000; i++) {
          const wall = next() < 0.5;
          estimator.add(wall ? gaussian(next) * 0.15 : -Math.atan2(1, 1.5 + 8 * next()));
        }
        expect(estimator.elevations).toBeNull();
      }),
      longProperty(9, 40),
    );
  });

  test('finds none closer together than the coordinates resolve', () => {
    const rings = even(128, -10, 12);
    expect(
      scan(
        rings,
        rings.map(() => 1),
        40_000,
        0.15 * DEGREE,
      ).elevations,
    ).toBeNull();
  });

  test('needs enough points, ignores what is no elevation, and forgets', () => {
    const rings = even(16, -15, 15);
    const few = scan(
      rings,
      rings.map(() => 1),
      1900,
      0.05 * DEGREE,
    );
    expect(few.elevations).toBeNull();
    for (const none of [Number.NaN, 2, -2, Number.POSITIVE_INFINITY]) few.add(none);
    for (let i = 0; i < 200; i++) few.add(rings[i % 16]!);
    expectRings(few.elevations, rings);
    few.reset();
    expect(few.elevations).toBeNull();
  });

  test('follows a LiDAR that is exchanged', () => {
    const estimator = scan(
      even(16, -15, 15),
      Array.from({ length: 16 }, () => 1),
      90_000,
      0.05 * DEGREE,
    );
    expect(estimator.elevations).toHaveLength(16);
    const next = numbers(3);
    const others = even(32, -16, 14.3);
    for (let i = 0; i < 1_000_000; i++) estimator.add(others[Math.floor(next() * 32)]!);
    expectRings(estimator.elevations, others);
  });
});
