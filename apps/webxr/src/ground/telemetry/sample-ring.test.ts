import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { SampleRing } from './sample-ring.ts';

const contents = (ring: SampleRing) =>
  Array.from({ length: ring.length }, (_, i) => [ring.timeAt(i), ring.valueAt(i)]);

describe('SampleRing', () => {
  test('keeps the newest samples in order of time, like a sorted list', () => {
    // Late by up to a few places, with repetitions.
    const steps = fc.array(fc.integer({ min: -5, max: 20 }), { maxLength: 900 });
    fc.assert(
      fc.property(steps, fc.integer({ min: 8, max: 600 }), (offsets, most) => {
        const ring = new SampleRing(most);
        let model: [number, number][] = [];
        offsets.forEach((offset, i) => {
          const time = i * 3 + offset;
          const verdict = ring.add(time, i);
          const known = model.some(([at]) => at === time);
          const isOld = model.length === most && model.every(([at]) => at > time);
          if (verdict === 'added') {
            expect(known || isOld).toBe(false);
            model = [...model, [time, i] as [number, number]].sort(([a], [b]) => a - b).slice(-most);
          } else expect(verdict).toBe(known ? 'duplicate' : 'late');
        });
        expect(contents(ring)).toEqual(model);
      }),
      { seed: 1, numRuns: 150 },
    );
  });

  test('finds the newest sample that is not newer than a time', () => {
    const times = fc.uniqueArray(fc.integer({ min: 0, max: 1000 }), { maxLength: 60 });
    fc.assert(
      fc.property(times, fc.integer({ min: -10, max: 1010 }), (unsorted, time) => {
        const sorted = unsorted.toSorted((a, b) => a - b);
        const ring = new SampleRing(64);
        for (const at of sorted) ring.add(at, at);
        expect(ring.indexAt(time)).toBe(sorted.findLastIndex((at) => at <= time));
      }),
      { seed: 2, numRuns: 300 },
    );
  });

  test('drops what is far too late', () => {
    const ring = new SampleRing(100);
    for (let i = 0; i < 300; i++) expect(ring.add(i, i)).toBe('added');
    expect(ring.length).toBe(100);
    expect(ring.timeAt(0)).toBe(200);
    expect(ring.add(150.5, 0)).toBe('late');
    expect(ring.add(210.5, 0)).toBe('late');
    expect(ring.add(290.5, 0)).toBe('added');
    ring.clear();
    expect(ring.length).toBe(0);
    expect(ring.indexAt(1e9)).toBe(-1);
  });
});
