import { expect, it } from 'vitest';
import { presentationFigures } from './presentation-figures.ts';

it('counts each picture once, and the spread of each presentation', () => {
  const figures = presentationFigures(
    [
      { finishedMs: 1050, drawnMs: [1000, 1000], cloudMs: 980 },
      { finishedMs: 1083, drawnMs: [1033, 1000], cloudMs: 980 },
      { finishedMs: 1100, drawnMs: [1033, null], cloudMs: 1080 },
      { finishedMs: 2050, drawnMs: [2000, 2000.5], cloudMs: null },
      { finishedMs: null, drawnMs: [3000, 3000], cloudMs: 3000 },
    ],
    [30, 15],
    10,
  );
  expect(figures.glassToGlassMs.map(({ max }) => max)).toEqual([50, 50]);
  expect(figures.framesPerSecond).toEqual([3, 2]);
  expect(figures.spreadMs.max).toBe(33);
  expect(figures.share1Ms).toBeCloseTo(2 / 3);
  // 33 ms are half an interval of the slower one.
  expect(figures.shareHalfInterval).toBe(1);
  expect([figures.cloudApartMs.max, figures.cloudHalfInterval]).toEqual([53, 2 / 3]);
  expect(figures.unreadable).toBe(1);
});

it('has no spread for a single camera', () => {
  expect(presentationFigures([{ finishedMs: 10, drawnMs: [5], cloudMs: null }], [30], 10).share1Ms).toBe(1);
});
