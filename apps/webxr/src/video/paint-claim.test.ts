import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { CLAIM_OVER_MS, LOST_MS, MOST_WAIT_MS, PaintClaim } from './paint-claim.ts';

const TICK_MS = 25;
const CLOUD_MS = 100;

/** A page that ticks, and to which a cloud comes every 100 ms. */
class Bench {
  readonly claim = new PaintClaim();
  nowMs = 0;

  /** @param paintedOf10 how many of ten clouds are painted, evenly spread @returns when the claim changed, ms from now */
  run(forMs: number, paintedOf10: number, possible = true): number | null {
    const [beganMs, before] = [this.nowMs, this.claim.claimed];
    while (this.nowMs - beganMs < forMs) {
      this.nowMs += TICK_MS;
      const cloud = this.nowMs / CLOUD_MS;
      if (Number.isInteger(cloud)) {
        this.claim.add(
          Math.floor(((cloud + 1) * paintedOf10) / 10) > Math.floor((cloud * paintedOf10) / 10),
          this.nowMs,
        );
      }
      this.claim.tick(possible, this.nowMs);
      if (this.claim.claimed !== before) return this.nowMs - beganMs;
    }
    return null;
  }
}

describe('a claim', () => {
  test('is made when at least four of five clouds were painted over 2 s', () => {
    expect(new Bench().run(20_000, 7)).toBeNull();
    const changed = new Bench().run(20_000, 8);
    expect(changed).toBeGreaterThanOrEqual(CLAIM_OVER_MS);
    expect(changed).toBeLessThan(CLAIM_OVER_MS + 500);
  });

  test('stays while the share hovers about that', () => {
    const bench = new Bench();
    bench.run(5000, 10);
    for (const painted of [9, 7, 8, 6, 8, 5, 9]) expect(bench.run(5000, painted)).toBeNull();
    expect(bench.claim.claimed).toBe(true);
  });

  test('is dropped when less than two of five are painted, or none for half a second', () => {
    const rare = new Bench();
    rare.run(5000, 10);
    expect(rare.run(5000, 3)).toBeLessThan(1500);
    const lost = new Bench();
    lost.run(5000, 10);
    expect(lost.run(5000, 0)).toBeLessThanOrEqual(LOST_MS + CLOUD_MS + TICK_MS);
  });

  test('is dropped at once when no video can paint', () => {
    const bench = new Bench();
    bench.run(5000, 10);
    expect(bench.run(100, 10, false)).toBe(TICK_MS);
  });

  test('waits longer after each claim that was short', () => {
    const bench = new Bench();
    const waits: (number | null)[] = [];
    for (let i = 0; i < 7; i++) {
      waits.push(bench.run(100_000, 10));
      bench.run(100_000, 0);
    }
    for (let i = 1; i < waits.length; i++) {
      const least = Math.min(CLAIM_OVER_MS * 2 ** i, MOST_WAIT_MS);
      expect(waits[i]).toBeGreaterThanOrEqual(least);
      expect(waits[i]).toBeLessThan(least + 1000);
    }
    bench.run(100_000, 10);
    bench.run(20_000, 10);
    bench.run(100_000, 0);
    expect(bench.run(100_000, 10)).toBeLessThan(CLAIM_OVER_MS + 1000);
  });
});

test('whatever comes: no claim sooner than 2 s after the one before, none without painted clouds', () => {
  const step = fc.record({
    afterMs: fc.integer({ min: 0, max: 700 }),
    cloud: fc.constantFrom('painted', 'plain', null),
    possible: fc.boolean(),
  });
  fc.assert(
    fc.property(fc.array(step, { maxLength: 300 }), fc.boolean(), (steps, always) => {
      const claim = new PaintClaim();
      let [nowMs, endedMs, paintedMs] = [0, 0, Number.NEGATIVE_INFINITY];
      let before = false;
      for (const { afterMs, cloud, possible } of steps) {
        nowMs += afterMs;
        if (cloud !== null) claim.add(cloud === 'painted', nowMs);
        if (cloud === 'painted') paintedMs = nowMs;
        claim.tick(always || possible, nowMs);
        if (claim.claimed) {
          expect(always || possible).toBe(true);
          expect(nowMs - paintedMs).toBeLessThanOrEqual(LOST_MS);
        }
        if (claim.claimed && !before) expect(nowMs - endedMs).toBeGreaterThanOrEqual(CLAIM_OVER_MS);
        if (!claim.claimed && before) endedMs = nowMs;
        before = claim.claimed;
      }
    }),
  );
});
