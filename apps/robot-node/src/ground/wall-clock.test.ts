import fc from 'fast-check';
import { expect, it } from 'vitest';
import { WallClock } from './wall-clock.ts';

/** Clocks of a machine whose system clock is `aheadMs` ahead of the monotonic one. */
function machine() {
  const clocks = { monotonicMs: 5000.25, aheadMs: 1.7e12 };
  const wall = new WallClock(
    () => Math.floor(clocks.monotonicMs + clocks.aheadMs),
    () => clocks.monotonicMs,
  );
  return { clocks, wall };
}

it('finds the fraction of a millisecond by and by, and keeps it', () => {
  const { clocks, wall } = machine();
  for (let i = 0; i < 100; i++) {
    clocks.monotonicMs += 0.37;
    expect(Math.abs(wall.offsetMs - clocks.aheadMs)).toBeLessThanOrEqual(1);
  }
  expect(wall.offsetMs).toBeCloseTo(clocks.aheadMs, 1);
});

it('follows a system clock that is set, forwards and backwards, by however much', () => {
  fc.assert(
    fc.property(fc.array(fc.double({ min: -1e11, max: 1e11, noNaN: true }), { maxLength: 20 }), (steps) => {
      const { clocks, wall } = machine();
      for (const step of steps) {
        clocks.aheadMs += step;
        clocks.monotonicMs += 10.3;
        expect(Math.abs(wall.offsetMs - clocks.aheadMs)).toBeLessThanOrEqual(1.001);
      }
    }),
  );
});

it('is not misled by what takes the processor between two readings', () => {
  const clocks = { monotonicMs: 5000.25, pauseMs: 0 };
  const wall = new WallClock(
    () => {
      clocks.monotonicMs += clocks.pauseMs;
      clocks.pauseMs = 0;
      return Math.floor(clocks.monotonicMs);
    },
    () => clocks.monotonicMs,
  );
  clocks.pauseMs = 50;
  expect(Math.abs(wall.offsetMs)).toBeLessThanOrEqual(1);
});
