/** A camera 1 m above the floor that looks along x: which of its depths are things or holes where a robot touches. */
import { expect, it } from 'vitest';
import { opticalMount } from '../sense/sources/sensor-mount.ts';
import { SeenThings } from './seen-things.ts';

const CAMERA = { fx: 10, fy: 10, cx: 0, cy: 0 };
const LEVEL = opticalMount({ x: 0, y: 0, z: 1, roll: 0, pitch: 0, yaw: 0 });
const RADIUS = 0.25;
const NEVER = Number.POSITIVE_INFINITY;

/** One pixel, by some pixels lower than straight ahead, where it would be 1 m high. A ditch crosses the way at x = 1 m. */
function seenAt(depth: number, rowsDown = 1, mount = LEVEL): SeenThings {
  const seen = new SeenThings({ x: 0, y: 0 }, (x) => Math.abs(x - 1) < 0.1);
  seen.take(Float32Array.of(depth), 1, { ...CAMERA, cy: -rowsDown }, mount, 700);
  return seen;
}

it('knows since when a thing was seen, and only where it stands', () => {
  const seen = seenAt(2);
  expect(seen.thingSinceMs({ x: 1.76, y: 0.01 }, RADIUS)).toBe(700);
  expect(seen.thingSinceMs({ x: 1.5, y: 0 }, RADIUS)).toBe(NEVER);
  expect(seen.thingSinceMs({ x: 2, y: 0.5 }, RADIUS)).toBe(NEVER);
});

it('keeps the first time', () => {
  const seen = seenAt(2);
  seen.take(Float32Array.of(2), 1, { ...CAMERA, cy: -1 }, LEVEL, 900);
  expect(seen.thingSinceMs({ x: 1.8, y: 0 }, RADIUS)).toBe(700);
});

it('knows where a thing was lately', () => {
  const seen = seenAt(2);
  expect(seen.thingSinceMs({ x: 1.8, y: 0 }, RADIUS, 700)).toBe(700);
  expect(seen.thingSinceMs({ x: 1.8, y: 0 }, RADIUS, 701)).toBe(NEVER);
});

it.each([
  ['floor', 1, NEVER, NEVER],
  ['a thing 20 cm high', 0.8, 700, NEVER],
  ['the inside of a hole', 1.3, NEVER, 700],
  ['a hole that gives no depth', 0, NEVER, 700],
])('tells %s from the others', (_, depth, thing, hole) => {
  const seen = seenAt(depth, 10);
  expect([seen.thingSinceMs({ x: 0.8, y: 0 }, RADIUS), seen.holeSinceMs({ x: 0.8, y: 0 }, RADIUS)]).toEqual([
    thing,
    hole,
  ]);
});

it('takes floor that gives no depth for no hole', () => {
  expect(seenAt(0, 7).holeSinceMs({ x: 1.4, y: 0 }, RADIUS)).toBe(NEVER);
});

it('places what it sees by the camera, wherever that looks', () => {
  const left = opticalMount({ x: 0.3, y: 0, z: 0.5, roll: 0, pitch: 0, yaw: Math.PI / 2 });
  const seen = seenAt(2, 1, left);
  expect(seen.thingSinceMs({ x: 0.3, y: 2 }, RADIUS)).toBe(700);
  expect(seen.thingSinceMs({ x: 2, y: 0 }, RADIUS)).toBe(NEVER);
});
