import { describe, expect, it } from 'vitest';
import { CollisionWorld, staticObstacles } from './collision.ts';
import { floorPlan, WaysTo } from './floor-plan.ts';
import { officeWorld } from './worlds/office.ts';

const CELL_M = 0.1;
const world = officeWorld();
const plan = floorPlan(world, CELL_M);
const valueAt = (x: number, y: number) =>
  plan.data[Math.floor((y - plan.y) / CELL_M) * plan.width + Math.floor((x - plan.x) / CELL_M)];

describe('the floor plan of the office', () => {
  it('has walls, doors, and nothing beyond', () => {
    const { start } = world;
    expect(valueAt(start.x, start.y)).toBe(0);
    // The wall between hall and corridor, and its opening.
    expect(valueAt(16, 7)).toBe(100);
    expect(valueAt(12.2, 7)).toBe(0);
    expect(valueAt(plan.x + 0.05, plan.y + 0.05)).toBe(-1);
    expect(plan.width * CELL_M).toBeCloseTo(21.2, 0);
  });

  it('is free only where nothing stands', () => {
    const collisions = new CollisionWorld(staticObstacles(world), []);
    plan.data.forEach((value, at) => {
      if (value !== 0) return;
      const x = plan.x + ((at % plan.width) + 0.5) * CELL_M;
      const y = plan.y + (Math.floor(at / plan.width) + 0.5) * CELL_M;
      if (collisions.clearance(x, y) <= 0) throw new Error(`${x}, ${y}`);
    });
    const free = plan.data.filter((value) => value === 0).length / plan.data.length;
    expect(free).toBeGreaterThan(0.5);
    expect(free).toBeLessThan(0.95);
  });
});

describe('ways', () => {
  it('lead through doors and stay away from what stands there', () => {
    const ways = new WaysTo(plan, 3.5, 3, 0.3);
    const way = ways.from(world.start.x, world.start.y);
    expect(way[0]).toEqual({ x: world.start.x, y: world.start.y });
    expect(Math.hypot((way.at(-1)?.x ?? 0) - 3.5, (way.at(-1)?.y ?? 0) - 3)).toBeLessThan(CELL_M);
    for (const [i, { x, y }] of way.entries()) {
      const before = way[i - 1];
      if (before === undefined) continue;
      expect(Math.hypot(x - before.x, y - before.y)).toBeLessThan(CELL_M * 2.2);
      for (const [dx, dy] of [
        [0, 0],
        [0.2, 0],
        [-0.2, 0],
        [0, 0.2],
        [0, -0.2],
      ] as const)
        expect(valueAt(x + dx, y + dy)).toBe(0);
    }
    // As the crow flies it is 8.7 m, through two walls.
    expect(way.length * CELL_M).toBeGreaterThan(9);
  });

  it('do not exist to a wall, or from where nothing is known', () => {
    expect(new WaysTo(plan, 16, 7, 0.3).from(world.start.x, world.start.y)).toEqual([]);
    const ways = new WaysTo(plan, 10, 6, 0.3);
    expect(ways.from(plan.x + 0.05, plan.y + 0.05)).toEqual([]);
    expect(ways.from(-100, 0)).toEqual([]);
  });

  it('lead away from where it is too narrow to stand', () => {
    const ways = new WaysTo(plan, 10, 6, 0.3);
    // 0.26 m from the wall, nearer than ways are.
    const way = ways.from(8.3, 5.32);
    expect(way[0]).toEqual({ x: 8.3, y: 5.32 });
    expect(way.length).toBeGreaterThan(10);
  });
});
