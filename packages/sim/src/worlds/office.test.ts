import { casesOf } from '@farpoint/network-sim/cases';
import { expect, test } from 'vitest';
import { CollisionWorld, staticObstacles } from '../collision.ts';
import { DEFAULT_LIMITS } from '../drive.ts';
import { MovingBody } from '../movers.ts';
import { officeWorld } from './office.ts';

const world = officeWorld();
const obstacles = new CollisionWorld(staticObstacles(world), []);

test('every room can be reached from the start', () => {
  const cell = 0.1;
  const key = (i: number, j: number) => i * 1000 + j;
  const begin: [number, number] = [Math.round(world.start.x / cell), Math.round(world.start.y / cell)];
  const seen = new Set([key(...begin)]);
  const queue = [begin];
  for (let next = queue.pop(); next; next = queue.pop()) {
    const [i, j] = next;
    for (const [a, b] of [
      [i + 1, j],
      [i - 1, j],
      [i, j + 1],
      [i, j - 1],
    ] as [number, number][]) {
      const free = obstacles.clearance(a * cell, b * cell) >= DEFAULT_LIMITS.radius;
      if (free && !seen.has(key(a, b))) {
        seen.add(key(a, b));
        queue.push([a, b]);
      }
    }
  }
  const rooms = { office: [3.5, 3], lab: [10, 2.5], storage: [16.4, 3.8], corridor: [1, 6], meeting: [6, 8] };
  for (const [name, [x, y]] of Object.entries({ ...rooms, dock: [world.dock!.x, world.dock!.y] })) {
    expect(seen.has(key(Math.round(x! / cell), Math.round(y! / cell))), name).toBe(true);
  }
  // The outer walls have no gaps.
  expect(seen.size).toBeLessThan((20 * 12) / (cell * cell));
});

test('people and carts walk through nothing stationary', () => {
  const nowhere = { x: 1e6, y: 1e6 };
  for (const mover of world.movers) {
    const body = new MovingBody(mover);
    const { halfWidth, margin } = body.obstacle;
    for (let i = 0; i < 2000; i++) {
      body.step(0.05, nowhere, 0);
      const { x, y } = body.obstacle;
      expect(obstacles.clearance(x, y), `${mover.name} at ${x}, ${y}`).toBeGreaterThan(halfWidth + margin);
    }
  }
});

test('people and carts keep out of each other’s way', () => {
  const nowhere = { x: 1e6, y: 1e6 };
  const bodies = world.movers.map((mover) => new MovingBody(mover));
  for (let i = 0; i < casesOf(20_000); i++) {
    for (const body of bodies) body.step(0.05, nowhere, 0);
    bodies.forEach((a, index) => {
      for (const b of bodies.slice(index + 1)) {
        const apart = Math.sqrt((a.obstacle.x - b.obstacle.x) ** 2 + (a.obstacle.y - b.obstacle.y) ** 2);
        if (apart < 0.54) expect.fail(`${a.mover.name} and ${b.mover.name} are ${apart} m apart`);
      }
    });
  }
});
