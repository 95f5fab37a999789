import { expect, test } from 'vitest';
import { GroundGrid, gridLines } from './ground-grid.ts';

test('has a line every metre near the robot, and every 4 m far away', () => {
  const reaches = new Map<string, number[]>();
  for (const [x0, z0, x1, z1] of gridLines()) {
    const [line, from, to] = x0 === x1 ? [`x ${x0}`, z0, z1] : [`z ${z0}`, x0, x1];
    expect(reaches.has(line)).toBe(false);
    reaches.set(line, [from, to]);
  }
  for (const axis of ['x', 'z']) {
    for (let at = -8; at <= 8; at++) {
      const reach = at % 4 === 0 ? 20 : at % 2 === 0 ? 12 : 8;
      expect(reaches.get(`${axis} ${at}`)).toEqual([-reach, reach]);
    }
    for (let at = 9; at <= 20; at++)
      expect([at, reaches.has(`${axis} ${at}`)]).toEqual([at, at % 4 === 0 || (at % 2 === 0 && at <= 12)]);
  }
});

test('tells both ends of a line where the other one is', () => {
  const { geometry } = new GroundGrid().object;
  const ends = (name: string) => {
    const { array } = geometry.getAttribute(name);
    return Array.from({ length: array.length / 3 }, (_, i) => [...array.slice(3 * i, 3 * i + 3)]);
  };
  const [own, other] = [ends('position'), ends('otherEnd')];
  expect(own).toHaveLength(2 * gridLines().length);
  own.forEach((end, i) => {
    expect(other[i % 2 === 0 ? i + 1 : i - 1]).toEqual(end);
  });
});

test('follows in steps that put its lines on lines', () => {
  const grid = new GroundGrid();
  grid.centreOn(1.4, -2.6);
  expect([grid.object.position.x, grid.object.position.z]).toEqual([0, -4]);
});

test('approaches the ground’s height', () => {
  const grid = new GroundGrid();
  grid.approach(-1.8);
  expect(grid.object.position.y).toBeCloseTo(-0.91);
  for (let i = 0; i < 10; i++) grid.approach(-1.8);
  expect(grid.object.position.y).toBeCloseTo(-1.81);
});
