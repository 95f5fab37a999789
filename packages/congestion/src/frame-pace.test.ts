import { someOf } from '@farpoint/network-sim/cases';
import { describe, expect, test } from 'vitest';
import { AdaptiveRateController } from './adaptive-rate-controller.ts';
import { FramePace } from './frame-pace.ts';
import type { RateDecision } from './rate-controller.ts';
import { losses, runScenario, type Scenario } from './testing/index.ts';

const M = 1e6;
const train = (sent: number, arrived: number) => ({
  sentBitsPerSecond: sent * M,
  arrivedBitsPerSecond: arrived * M,
});

describe('the pace of a frame', () => {
  test('doubles with each train that arrives as it was sent, up to 8 times what the sources use', () => {
    const pace = new FramePace(60 * M);
    expect(pace.trainRate(120 * M, 0)).toBe(240 * M);
    pace.onOutcome(train(240, 240), 100);
    expect(pace.trainRate(120 * M, 100)).toBe(456 * M);
    pace.onOutcome(train(480, 470), 200);
    expect(pace.bitsPerSecond).toBe(446.5 * M);
    expect(pace.trainRate(120 * M, 60_000)).toBeNull();
  });

  test('is what a path that spreads the train has carried, and the next train waits twice as long', () => {
    const pace = new FramePace(60 * M);
    const waits: number[] = [];
    for (let now = 0; waits.length < 7; ) {
      pace.onOutcome(train(240, 200), now);
      const from = now;
      while (pace.trainRate(120 * M, now) === null && now < 1e6) now += 100;
      waits.push(now - from);
    }
    expect(pace.bitsPerSecond).toBe(170 * M);
    expect(waits).toEqual([1000, 2000, 4000, 8000, 16_000, 30_000, 30_000]);
  });

  test('is never above 500 Mbit/s', () => {
    const pace = new FramePace(200 * M);
    expect(pace.trainRate(400 * M, 0)).toBe(500 * M);
    expect(pace.trainRate(500 * M, 0)).toBeNull();
    pace.onOutcome(train(900, 900), 0);
    expect(pace.bitsPerSecond).toBe(500 * M);
  });

  test('outlives one queue now and then, and not three in a row', () => {
    const pace = new FramePace(60 * M);
    pace.onOutcome(train(480, 480), 0);
    for (let i = 0; i < 100; i++) pace.onMessage(i % 5 === 0, i);
    expect(pace.bitsPerSecond).toBeGreaterThan(0);
    for (let i = 0; i < 3; i++) pace.onMessage(true, 1000);
    expect(pace.bitsPerSecond).toBe(0);
    expect(pace.trainRate(120 * M, 1999)).toBeNull();
    expect(pace.trainRate(120 * M, 2000)).toBe(240 * M);
  });
});

describe('on a path', () => {
  /** A cloud of 250 kB, 30 times a second, is all that the sources have. */
  function run(scenario: Partial<Scenario>) {
    const decisions: (RateDecision & { atMs: number })[] = [];
    class Watched extends AdaptiveRateController {
      override update(nowMs: number): void {
        super.update(nowMs);
        decisions.push({ ...this.decision(nowMs), atMs: nowMs });
      }
    }
    const outcome = runScenario(
      { name: 'pace', durationMs: 20_000, capacity: [], rttMs: 5, queueMs: 20, ...scenario },
      () => new Watched({ maxBitsPerSecond: 60 * M }),
    );
    const paces = (fromMs: number, toMs = Number.POSITIVE_INFINITY) =>
      decisions
        .filter(({ atMs }) => atMs >= fromMs && atMs < toMs)
        .map(({ pacingBitsPerSecond }) => pacingBitsPerSecond / M);
    return { media: outcome.media[0]!, decisions, paces };
  }

  test.each(someOf([130, 200, 300]))('of %i Mbit/s, frames go no faster than it', (mbps) => {
    const { paces, media } = run({ capacity: [{ atMs: 0, mbps }] });
    expect(Math.max(...paces(0))).toBeLessThan(1.15 * mbps);
    expect(losses(media, 0, 20_000).overflow).toBe(0);
  });

  test.each(someOf([0, 7, 19, 31]))(
    'of 1 Gbit/s, frames go at 8 times what the sources use; as slowly as it within 0.4 s when it becomes slower (%i ms later)',
    (late) => {
      const down = 10_000 + late;
      const { decisions, paces, media } = run({
        capacity: [
          { atMs: 0, mbps: 1000 },
          { atMs: down, mbps: 100 },
        ],
        seed: 3 + late,
      });
      expect(Math.min(...paces(5000, down))).toBeGreaterThan(400);
      // Whose rate stays what it is.
      expect(Math.max(...decisions.map(({ targetBitsPerSecond }) => targetBitsPerSecond))).toBe(60 * M);
      expect(Math.max(...paces(down + 400))).toBeLessThan(140);
      expect(losses(media, 0, 20_000).overflow).toBeLessThan(0.005);
    },
  );

  test('that loses what comes in bursts, frames are sent evenly again', () => {
    const { paces } = run({
      capacity: [
        { atMs: 0, mbps: 1000 },
        { atMs: 10_000, mbps: 100 },
      ],
      queueMs: 1,
    });
    expect(Math.max(...paces(11_000))).toBeLessThan(140);
  });

  test('on which nothing comes back for a second, the search begins anew', () => {
    const { paces } = run({
      capacity: [
        { atMs: 0, mbps: 1000 },
        { atMs: 10_000, mbps: 0 },
        { atMs: 11_000, mbps: 1000 },
      ],
    });
    expect(Math.min(...paces(10_900, 11_000))).toBeLessThan(1);
    expect(Math.min(...paces(16_000))).toBeGreaterThan(400);
  });
});
