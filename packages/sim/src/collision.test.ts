import fc from 'fast-check';
import { expect, test } from 'vitest';
import { CollisionWorld, type Obstacle, separation } from './collision.ts';

const RADIUS = 0.25;

function rectangle(x: number, y: number, halfLength: number, halfWidth: number, yaw = 0): Obstacle {
  return { x, y, cos: Math.cos(yaw), sin: Math.sin(yaw), halfLength, halfWidth, margin: 0 };
}

const blank = () => ({ distance: 0, normalX: 0, normalY: 0 });

test('separation from sides, corners, the inside and a disc', () => {
  const square = rectangle(0, 0, 1, 1);
  expect(separation(square, 3, 0.5, blank())).toEqual({ distance: 2, normalX: 1, normalY: 0 });
  expect(separation(square, 0, -1.5, blank())).toEqual({ distance: 0.5, normalX: 0, normalY: -1 });
  expect(separation(square, 4, 5, blank())).toEqual({ distance: 5, normalX: 0.6, normalY: 0.8 });
  expect(separation(square, 0.9, 0.2, blank()).distance).toBeCloseTo(-0.1, 12);
  const disc = { ...rectangle(1, 1, 0, 0), margin: 0.5 };
  expect(separation(disc, 1, 3, blank()).distance).toBeCloseTo(1.5, 12);
});

test('slides along a wall and reports the contact', () => {
  const world = new CollisionWorld([rectangle(0, 1, 10, 0.1)], []);
  const moved = world.move({ x: 0, y: 0.64 }, { x: 0.01, y: 0.66 }, RADIUS);
  expect(moved.contact).toBe(true);
  expect(moved.x).toBeCloseTo(0.01, 9);
  expect(moved.y).toBeCloseTo(0.65, 5);
});

test('does not move into a gap that is too narrow', () => {
  const world = new CollisionWorld([rectangle(1, 1, 0.5, 0.8), rectangle(1, -1, 0.5, 0.8)], []);
  let position = { x: 0, y: 0 };
  for (let i = 0; i < 1000; i++) position = world.move(position, { x: position.x + 0.002, y: 0 }, RADIUS);
  expect(position.x).toBeLessThan(0.5);
  expect(world.clearance(position.x, position.y)).toBeGreaterThanOrEqual(RADIUS);
});

test('random walks among random obstacles never overlap one', () => {
  const place = fc.double({ min: -3, max: 3, noNaN: true });
  const half = fc.double({ min: 0.02, max: 1, noNaN: true });
  const obstacle = fc.tuple(place, place, half, half, place).map((a) => rectangle(...a));
  const step = fc.tuple(
    fc.double({ min: -0.01, max: 0.01, noNaN: true }),
    fc.double({ min: -0.01, max: 0.01, noNaN: true }),
  );
  fc.assert(
    fc.property(
      fc.array(obstacle, { maxLength: 12 }),
      fc.array(step, { maxLength: 60 }),
      (obstacles, steps) => {
        const world = new CollisionWorld(obstacles, []);
        let position = { x: 0, y: 0 };
        fc.pre(world.clearance(0, 0) >= RADIUS);
        for (const [dx, dy] of steps) {
          for (let i = 0; i < 10; i++) {
            position = world.move(position, { x: position.x + dx, y: position.y + dy }, RADIUS);
            expect(world.clearance(position.x, position.y)).toBeGreaterThanOrEqual(RADIUS);
          }
        }
      },
    ),
    { seed: 1 },
  );
});
