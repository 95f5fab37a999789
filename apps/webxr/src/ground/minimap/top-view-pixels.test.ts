import { TOP_VIEW } from '@farpoint/operator';
import { expect, test } from 'vitest';
import { writeTopView } from './top-view-pixels.ts';

const { cells, lowestM, stepM } = TOP_VIEW;

test('heights have colours, old things are darker, and what nobody has seen is transparent', () => {
  const view = { heights: new Uint8Array(cells * cells), ages: new Uint8Array(cells * cells) };
  const put = (column: number, row: number, metres: number, age: number) => {
    view.heights[row * cells + column] = Math.round((metres - lowestM) / stepM) + 1;
    view.ages[row * cells + column] = age;
  };
  put(0, 0, 0, 0);
  put(1, 0, 0, 200);
  put(2, 0, 1.9, 0);
  put(3, 0, -0.5, 0);
  put(5, 7, 0.5, 0);
  const pixels = new Uint8ClampedArray(4 * cells * cells);
  writeTopView(view, pixels);
  const at = (column: number, row: number) => {
    const from = ((cells - 1 - row) * cells + column) * 4;
    return [...pixels.subarray(from, from + 4)] as [number, number, number, number];
  };
  const [floor, oldFloor, tall, drop] = [at(0, 0), at(1, 0), at(2, 0), at(3, 0)];
  expect(oldFloor[0]).toBeLessThan(floor[0] / 2);
  expect(oldFloor[3]).toBe(255);
  // Yellow and red.
  expect(Math.min(tall[0], tall[1]) - tall[2]).toBeGreaterThan(80);
  expect(drop[0] - Math.max(drop[1], drop[2])).toBeGreaterThan(100);
  expect(at(5, 7)[3]).toBe(255);
  expect(at(6, 7)[3]).toBe(0);
  expect(pixels.filter((_, i) => i % 4 === 3).reduce((sum, opacity) => sum + opacity / 255, 0)).toBe(5);
});
