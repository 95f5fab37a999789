import fc from 'fast-check';
import { expect, test } from 'vitest';
import { TimeHeap } from './time-heap.ts';

test('returns items in order of time, and in order of insertion if times are equal', () => {
  fc.assert(
    fc.property(fc.array(fc.integer({ min: 0, max: 9 }), { maxLength: 60 }), fc.nat(60), (times, early) => {
      const heap = new TimeHeap<number>();
      const out: number[] = [];
      const left: { time: number; index: number }[] = [];
      for (const [index, time] of times.entries()) {
        heap.push(time, index);
        left.push({ time, index });
        if (index !== early) continue;
        left.sort((a, b) => a.time - b.time || a.index - b.index);
        expect(heap.headMs).toBe(left[0]!.time);
        expect(heap.shift()).toBe(left.shift()!.index);
      }
      while (heap.length > 0) out.push(heap.shift());
      left.sort((a, b) => a.time - b.time || a.index - b.index);
      expect(out).toEqual(left.map(({ index }) => index));
      expect(heap.headMs).toBe(Number.POSITIVE_INFINITY);
    }),
    { seed: 1 },
  );
});
