import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type ClipPicture, ClipRing } from './clip-ring.ts';

const INTERVAL_US = 100_000;
const picture = (k: number, every = 20, length = 1000): ClipPicture => ({
  key: k % every === 0,
  timestampUs: k * INTERVAL_US,
  bytes: new Uint8Array(length),
});

describe('ClipRing', () => {
  it('keeps the last seconds, from a key picture on, and at most a group more', () => {
    const ring = new ClipRing({ seconds: 30, mostBytes: 1e9 });
    for (let k = 0; k < 1000; k++) ring.add(picture(k));
    const { pictures } = ring;
    expect(pictures[0]?.key).toBe(true);
    expect(pictures.at(-1)?.timestampUs).toBe(99_900_000);
    const seconds = (99_900_000 - (pictures[0]?.timestampUs ?? 0)) / 1e6;
    expect(seconds).toBeGreaterThanOrEqual(30);
    expect(seconds).toBeLessThanOrEqual(32);
    expect(ring.bytes).toBe(pictures.length * 1000);
  });

  it('has nothing before the first key picture', () => {
    const ring = new ClipRing({ seconds: 30, mostBytes: 1e9 });
    ring.add(picture(1));
    expect(ring.pictures).toEqual([]);
    ring.add(picture(20));
    expect(ring.pictures).toHaveLength(1);
    ring.clear();
    expect([ring.pictures, ring.bytes]).toEqual([[], 0]);
  });

  it('stays within its bytes but for the newest group, and can always be decoded', () => {
    fc.assert(
      fc.property(
        fc.array(
          fc.record({ key: fc.boolean(), length: fc.integer({ min: 0, max: 5000 }), gapMs: fc.nat(4000) }),
          { maxLength: 200 },
        ),
        fc.record({ seconds: fc.integer({ min: 1, max: 30 }), mostBytes: fc.nat(50_000) }),
        (added, limits) => {
          const ring = new ClipRing(limits);
          let timestampUs = 0;
          let newestGroup = 0;
          for (const { key, length, gapMs } of added) {
            timestampUs += gapMs * 1000;
            ring.add({ key, timestampUs, bytes: new Uint8Array(length) });
            newestGroup = key ? length : newestGroup + length;
            const { pictures } = ring;
            if (pictures.length === 0) continue;
            expect(pictures[0]?.key).toBe(true);
            expect(pictures.at(-1)?.timestampUs).toBe(timestampUs);
            expect(ring.bytes).toBe(pictures.reduce((sum, { bytes }) => sum + bytes.length, 0));
            expect(ring.bytes).toBeLessThanOrEqual(Math.max(limits.mostBytes, newestGroup));
          }
        },
      ),
    );
  });
});
