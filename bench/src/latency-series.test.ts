import { expect, it } from 'vitest';
import { latencySeries } from './latency-series.ts';

it('averages each camera’s latency in steps of 5 s, and counts each picture once', () => {
  const rows = [
    { finishedMs: 1000, drawnMs: [950, null] },
    // The same picture of the first camera again.
    { finishedMs: 1100, drawnMs: [950, 1000] },
    { finishedMs: 1200, drawnMs: [1130, 1000] },
    { finishedMs: null, drawnMs: [1500, 1500] },
    { finishedMs: 7000, drawnMs: [6900, null] },
    { finishedMs: 11_000, drawnMs: [10_000, null] },
  ];
  const [first, second] = latencySeries(rows, 2);
  expect(first).toEqual({ s: [2.5, 7.5], ms: [60, 100] });
  expect(second!.ms[0]).toBe(100);
  expect(second!.ms[1]).toBeNaN();
});

it('has no averages without presentations', () => {
  expect(latencySeries([], 1)).toEqual([{ s: [], ms: [] }]);
});
