import { expect, test } from 'vitest';
import { writePathRibbon } from './path-ribbon.ts';

/** Left and right of each point, metres, rounded to millimetres. @param text points as `x y, x y` */
function sides(text: string, capacity?: number): number[][] {
  const points = text.split(', ').map((point) => point.split(' ').map(Number) as [number, number]);
  const into = new Float32Array((capacity ?? points.length) * 6);
  const count = writePathRibbon(points, 0.5, into);
  return Array.from({ length: count }, (_, i) =>
    [0, 1, 3, 4].map((at) => Math.round((into[6 * i + at] as number) * 1000) / 1000 + 0),
  );
}

test('a straight ribbon has its width to both sides', () => {
  expect(sides('0 0, 2 0, 4 0')).toEqual([0, 2, 4].map((x) => [x, 0.5, x, -0.5]));
});

test('a corner is mitred, and the ribbon keeps its width', () => {
  expect(sides('0 0, 2 0, 2 2')[1]).toEqual([1.5, 0.5, 2.5, -0.5]);
});

test('no corner is longer than √2 widths, and a turn on the spot has a width', () => {
  const lengths = Array.from({ length: 180 }, (_, degrees) => {
    const turn = (degrees * Math.PI) / 180;
    const [x = 0, y = 0] = sides(`0 0, 2 0, ${2 + Math.cos(turn)} ${Math.sin(turn)}`)[1] ?? [];
    return Math.hypot(x - 2, y);
  });
  expect(Math.max(...lengths)).toBeCloseTo(Math.SQRT2, 1);
  expect(sides('0 0, 2 0, 0 0')[1]).toEqual([2, 0.5, 2, -0.5]);
});

test('equal points have the direction of their neighbours, and no more is written than there is room', () => {
  expect(sides('0 0, 1 0, 1 0, 2 0').map(([, left]) => left)).toEqual([0.5, 0.5, 0.5, 0.5]);
  expect(sides('0 0, 1 0, 2 0', 2)).toHaveLength(2);
  expect(sides('3 4')).toEqual([[3, 4, 3, 4]]);
});
