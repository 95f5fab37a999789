import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { allocate, type StreamClaim } from './allocation.ts';

const MESSAGES: StreamClaim = {
  name: 'messages',
  priority: 0,
  weight: 1,
  leastBitsPerSecond: 50e3,
  mostBitsPerSecond: 100e3,
};
const CLOUD: StreamClaim = {
  name: 'cloud',
  priority: 1,
  weight: 3,
  leastBitsPerSecond: 100e3,
  mostBitsPerSecond: 60e6,
};
const CAMERA: StreamClaim = {
  name: 'camera',
  priority: 1,
  weight: 1,
  leastBitsPerSecond: 300e3,
  mostBitsPerSecond: 2e6,
};
const rates = (total: number, claims: readonly StreamClaim[]) => Object.fromEntries(allocate(total, claims));

describe('allocate', () => {
  it('serves what safety needs before anything else', () => {
    expect(rates(30e3, [CAMERA, CLOUD, MESSAGES])).toEqual({ messages: 30e3, cloud: 0, camera: 0 });
    expect(rates(200e3, [CLOUD, MESSAGES])).toEqual({ messages: 100e3, cloud: 100e3 });
  });

  it('shares by weight, and redistributes what a stream cannot use', () => {
    expect(rates(4.5e6, [MESSAGES, CLOUD, CAMERA])).toEqual({ messages: 100e3, cloud: 3.1e6, camera: 1.3e6 });
    expect(rates(40e6, [MESSAGES, CLOUD, CAMERA])).toEqual({ messages: 100e3, cloud: 37.9e6, camera: 2e6 });
    expect(rates(100e6, [MESSAGES, CLOUD, CAMERA])).toEqual({ messages: 100e3, cloud: 60e6, camera: 2e6 });
  });

  it('never allocates more than there is or than can be used, and leaves nothing that a stream could use', () => {
    const claim = fc.record({
      priority: fc.integer({ min: 0, max: 2 }),
      weight: fc.integer({ min: 1, max: 5 }),
      leastBitsPerSecond: fc.integer({ min: 0, max: 1_000_000 }),
      mostBitsPerSecond: fc.integer({ min: 0, max: 5_000_000 }),
    });
    fc.assert(
      fc.property(
        fc.integer({ min: -5, max: 20_000_000 }),
        fc.array(claim, { maxLength: 6 }),
        (total, parts) => {
          const claims = parts.map((part, i) => ({ name: String(i), ...part }));
          const given = allocate(total, claims);
          const sum = [...given.values()].reduce((a, b) => a + b, 0);
          expect(sum).toBeLessThanOrEqual(Math.max(total, 0) + 1e-3);
          let wanted = 0;
          for (const { name, mostBitsPerSecond } of claims) {
            wanted += mostBitsPerSecond;
            expect(given.get(name)).toBeGreaterThanOrEqual(0);
            expect(given.get(name)).toBeLessThanOrEqual(mostBitsPerSecond + 1e-3);
          }
          expect(sum).toBeGreaterThanOrEqual(Math.min(Math.max(total, 0), wanted) - 1e-3);
        },
      ),
    );
  });
});
