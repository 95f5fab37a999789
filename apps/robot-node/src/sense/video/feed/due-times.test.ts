import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { DueTimes } from './sim-trigger.ts';

describe('DueTimes', () => {
  it('are multiples of the interval, common to all of one interval', () => {
    const times = new DueTimes<string>();
    times.add('a', 10n, 1003n);
    times.add('b', 10n, 1008n);
    times.add('slow', 20n, 1004n);
    expect(times.next).toBe(1010n);
    expect(times.take(1009n)).toEqual([]);
    expect(times.take(1012n).map(({ item, atNs }) => [item, atNs])).toEqual([
      ['a', 1010n],
      ['b', 1010n],
    ]);
    expect(times.next).toBe(1020n);
    expect(times.take(1020n).map(({ item }) => item)).toEqual(['a', 'b', 'slow']);
    times.delete('a');
    times.delete('b');
    expect(times.next).toBe(1040n);
    times.delete('slow');
    expect(times.next).toBeNull();
  });

  it('never come twice, never early, and those that were missed do not come', () => {
    fc.assert(
      fc.property(
        fc.bigInt(1n, 1000n),
        fc.array(fc.bigInt(0n, 5000n), { maxLength: 30 }),
        (interval, steps) => {
          const times = new DueTimes<number>();
          times.add(0, interval, 0n);
          let now = 0n;
          let last = 0n;
          for (const step of steps) {
            now += step;
            for (const { atNs } of times.take(now)) {
              expect(atNs % interval).toBe(0n);
              expect(atNs > last && atNs <= now && now - atNs < interval).toBe(true);
              last = atNs;
            }
            expect(times.next! > now).toBe(true);
          }
        },
      ),
    );
  });
});
