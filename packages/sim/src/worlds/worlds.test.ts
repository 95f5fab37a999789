import { expect, test } from 'vitest';
import { CollisionWorld, staticObstacles } from '../collision.ts';
import { MovingBody } from '../movers.ts';
import { SimulatedBase } from '../simulated-base.ts';
import { SimulatedCamera } from '../simulated-camera.ts';
import { concourseWorld } from './concourse.ts';
import { dockWorld } from './dock.ts';
import { warehouseWorld } from './warehouse.ts';

const worlds = [warehouseWorld(), concourseWorld(), dockWorld()].map((world) => [world.name, world] as const);

test.each(worlds)('people and carts walk through nothing stationary: %s', (_, world) => {
  const obstacles = new CollisionWorld(staticObstacles(world), []);
  const nowhere = { x: 1e6, y: 1e6 };
  for (const mover of world.movers) {
    const body = new MovingBody(mover);
    const { halfWidth, margin } = body.obstacle;
    for (let i = 0; i < 2000; i++) {
      body.step(0.05, nowhere, 0);
      const { x, y } = body.obstacle;
      const clearance = obstacles.clearance(x, y);
      if (clearance <= halfWidth + margin) expect.fail(`${mover.name} at ${x}, ${y}: ${clearance}`);
    }
  }
});

test.each(worlds)('a camera sees the floor and what stands on it: %s', async (_, world) => {
  const base = new SimulatedBase(world);
  const camera = await SimulatedCamera.create({ world, seed: 1, camera: { width: 64, height: 64 } });
  const { depth } = camera.render(base.snapshot, { points: false });
  expect(depth.filter((z) => z > 0.5 && z < 13).length).toBeGreaterThan(0.7 * depth.length);
  camera.close();
});

test('a base knows how far a place is from everything', () => {
  const base = new SimulatedBase(concourseWorld());
  expect(base.clearanceAt(9, 1.2)).toBe(base.clearance);
  expect(base.clearanceAt(9, 7)).toBeLessThan(0);
});
