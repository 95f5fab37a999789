import { describe, expect, test } from 'vitest';
import { TICKS_PER_S, ticksOf } from './memory-layout.ts';
import { TOP_VIEW, TOP_VIEW_BYTES, TopView } from './top-view.ts';
import { WorldMap } from './world-map.ts';

const NOW = ticksOf(600_000);
const { cells, cellM } = TOP_VIEW;
const MIDDLE = (cells * cellM) / 2;

function seen(...places: readonly (readonly [x: number, y: number, z: number, agoS: number])[]): WorldMap {
  const map = new WorldMap({ pages: 64 });
  for (const [x, y, z, agoS] of places) map.restore(x, y, z, 0xffff, NOW - agoS * TICKS_PER_S);
  return map;
}

function from(map: WorldMap, area: { x?: number; y?: number; ground?: number; ceiling?: number } = {}) {
  const view = new TopView(new ArrayBuffer(TOP_VIEW_BYTES));
  view.fill(map.store, { x: 0, y: 0, ground: 0, ceiling: 2, ...area }, NOW);
  const cellAt = (x: number, y: number) =>
    Math.floor((y - view.y) / cellM) * cells + Math.floor((x - view.x) / cellM);
  const heightAt = (x: number, y: number) => {
    const step = view.heights[cellAt(x, y)] as number;
    return step === 0 ? null : TOP_VIEW.lowestM + (step - 1) * TOP_VIEW.stepM;
  };
  return { view, heightAt, ageAt: (x: number, y: number) => view.ages[cellAt(x, y)] };
}

describe('the view from above', () => {
  test('has the highest of each cell below the ceiling, and its age', () => {
    const map = seen([3.05, -2.05, 0, 40], [3.06, -2.06, 0.8, 8], [3.05, -2.05, 2.4, 1], [-4, 5, 0.02, 100]);
    const { view, heightAt, ageAt } = from(map);
    expect(heightAt(3.05, -2.05)).toBeCloseTo(0.8, 1);
    expect(ageAt(3.05, -2.05)).toBe(2);
    expect(heightAt(-4, 5)).toBeCloseTo(0.02, 1);
    expect(heightAt(0, 0)).toBeNull();
    expect(view.heights.filter((height) => height > 0)).toHaveLength(2);
    expect(view.oldestS).toBe(100);
  });

  test('is around the robot, above its ground, and shows drops', () => {
    const map = seen([100, 50, 4.9, 0], [101, 50, 5.5, 0], [100, 51, 3.5, 0]);
    const { view, heightAt } = from(map, { x: 100, y: 50, ground: 5 });
    expect(view.x).toBeCloseTo(100 - MIDDLE, 1);
    expect(heightAt(100, 50)).toBeCloseTo(-0.1, 1);
    expect(heightAt(101, 50)).toBeCloseTo(0.5, 1);
    // Deeper than the scale reaches: nothing is claimed.
    expect(heightAt(100, 51)).toBeNull();
  });

  test('stays on whole cells when the robot moves a little, and leaves out what is beside it', () => {
    const map = seen([1, 1, 0, 0], [30, 0, 0, 0], [0, -MIDDLE - 0.2, 0, 0]);
    const { view } = from(map);
    expect(view.heights.filter((height) => height > 0)).toHaveLength(1);
    const { view: later } = from(map, { x: 0.07, y: -0.05 });
    expect((later.x - view.x) / cellM).toBeCloseTo(1, 9);
    expect(later.y).toBe(view.y);
  });

  test('of nothing says so', () => {
    const { view } = from(seen());
    expect(view.oldestS).toBeNull();
    expect(view.heights.every((height) => height === 0)).toBe(true);
  });
});
