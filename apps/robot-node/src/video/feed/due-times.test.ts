import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { DueTimes } from './due-times.ts';

const MS = 1_000_000n;
const DAY_NS = 86_400n * 1_000_000_000n;

describe('DueTimes', () => {
  it('are multiples of the interval, common to all of one rate', () => {
    const times = new DueTimes<string>();
    times.add('a', 100, 1003n * MS);
    times.add('b', 100, 1008n * MS);
    times.add('slow', 50, 1004n * MS);
    expect(times.next).toBe(1010n * MS);
    expect(times.take(1009n * MS)).toEqual([]);
    expect(times.take(1012n * MS).map(({ item, atNs }) => [item, atNs])).toEqual([
      ['a', 1010n * MS],
      ['b', 1010n * MS],
    ]);
    expect(times.next).toBe(1020n * MS);
    expect(times.take(1020n * MS).map(({ item }) => item)).toEqual(['a', 'b', 'slow']);
    times.delete('a');
    times.delete('b');
    expect(times.next).toBe(1040n * MS);
    times.delete('slow');
    expect(times.next).toBeNull();
  });

  it('do not drift: every whole second is one of them, whatever the uptime', () => {
    for (const rate of [1, 3, 7, 15, 30, 60, 90])
      for (const days of [1n, 30n, 1000n]) {
        const times = new DueTimes<number>();
        times.add(rate, rate, days * DAY_NS - 1n);
        expect(times.next).toBe(days * DAY_NS);
      }
  });

  it('never come twice, never early, and those that were missed do not come', () => {
    fc.assert(
      fc.property(
        fc.integer({ min: 1, max: 200_000 }),
        fc.bigInt(0n, 10_000n * DAY_NS),
        fc.array(fc.bigInt(0n, 5_000_000_000n), { maxLength: 30 }),
        (thousandths, start, steps) => {
          const intervalNs = 1_000_000_000_000n / BigInt(thousandths) + 1n;
          const times = new DueTimes<number>();
          times.add(0, thousandths / 1000, start);
          let now = start;
          let last = start;
          for (const step of steps) {
            now += step;
            const due = times.next!;
            const taken = times.take(now);
            expect(taken.length).toBe(due <= now ? 1 : 0);
            for (const { atNs } of taken) {
              expect(atNs > last && atNs >= due && atNs <= now && now - atNs < intervalNs).toBe(true);
              last = atNs;
            }
            expect(times.next! > now && times.next! - now <= intervalNs).toBe(true);
          }
        },
      ),
    );
  });
});
