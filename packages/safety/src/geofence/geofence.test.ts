import type { Twist } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import { FREE } from '../motion/motion-guard.ts';
import { depthIn, type Place } from './area.ts';
import { clearance, type Fence } from './fence.ts';
import { defaultGeofenceOptions, type FencePose, Geofence } from './geofence.ts';
import { freeLength, placeOn } from './path.ts';

const square: Place[] = [
  [-5, -5],
  [5, -5],
  [5, 5],
  [-5, 5],
];
const room: Fence = {
  allowed: [{ shape: 'polygon', rings: [square] }],
  ...{ forbidden: [], slow: [], radiusM: null },
};
const pose: FencePose = { x: 0, y: 0, yaw: 0, linear: 0, angular: 0, errorM: 0, atMs: 1000 };
const NOW = 1020;

function ask(fence: Fence, at: Partial<FencePose> | null, linear: number, angular = 0, nowMs = NOW) {
  const guard = new Geofence(fence, defaultGeofenceOptions, () => (at === null ? null : { ...pose, ...at }));
  const wish: Twist = { linear: { x: linear, y: 0, z: 0 }, angular: { x: 0, y: 0, z: angular } };
  return guard.bound(wish, nowMs);
}

describe('areas', () => {
  test('a polygon with a hole', () => {
    const hole: Place[] = [
      [-1, -1],
      [1, -1],
      [1, 1],
      [-1, 1],
    ];
    const area = { shape: 'polygon', rings: [square, hole] } as const;
    expect(depthIn(area, 3, 0)).toBe(2);
    expect(depthIn(area, 0, 0)).toBe(-1);
    expect(depthIn(area, 8, 9)).toBe(-5);
    expect(depthIn(area, 1, 1)).toBeCloseTo(0);
  });

  test('what is forbidden, and a radius, take from what is allowed', () => {
    const fence: Fence = {
      ...room,
      ...{ forbidden: [{ shape: 'circle', centre: [2, 0], radiusM: 0.5 }], radiusM: 3 },
    };
    expect(clearance(fence, 0, 0)).toBe(1.5);
    expect(clearance(fence, 2, 0)).toBe(-0.5);
    expect(clearance(fence, 0, 2.5)).toBe(0.5);
    expect(clearance({ ...room, allowed: [] }, 99, 99)).toBe(Number.POSITIVE_INFINITY);
  });
});

describe('the way along an arc', () => {
  test('a quarter of a circle to the left', () => {
    const [x, y] = placeOn({ x: 1, y: 2, direction: 0, bend: 0.5 }, Math.PI);
    expect([x, y]).toEqual([expect.closeTo(3), expect.closeTo(4)]);
  });

  test('ends where the distance does', () => {
    const wall = (x: number) => 5 - x;
    expect(freeLength({ x: 0, y: 0, direction: 0, bend: 0 }, wall, 0, 99)).toBeCloseTo(5, 2);
    expect(freeLength({ x: 0, y: 0, direction: 0, bend: 0 }, wall, 0, 3)).toBe(3);
    expect(freeLength({ x: 0, y: 0, direction: Math.PI, bend: 0 }, wall, 0, 99)).toBe(99);
    expect(freeLength({ x: 0, y: 0, direction: 0, bend: 0 }, wall, 0.25, 99)).toBeCloseTo(4, 2);
  });
});

describe('the guard', () => {
  test('lets the robot go in the middle, along a wall, and away from one', () => {
    expect(ask(room, {}, 1)).toBe(FREE);
    expect(ask(room, { y: 4.3, linear: 1 }, 1)).toBe(FREE);
    expect(ask(room, { x: 4.3, yaw: Math.PI }, 1)).toBe(FREE);
    expect(ask(room, { x: 4.3 }, -1)).toBe(FREE);
    expect(ask(room, { x: 4.3 }, 0, 1)).toBe(FREE);
  });

  test('slows towards the edge, then stands', () => {
    const factors = [2.5, 3, 3.5, 4, 4.3, 4.46].map((x) => ask(room, { x }, 1).factor);
    expect(factors[0]).toBe(1);
    expect(factors.toSorted((a, b) => b - a)).toEqual(factors);
    expect(ask(room, { x: 3.5 }, 1)).toMatchObject({ reason: 'fence-near', urgent: false });
    // Nearer than 3 cm it stands.
    expect(ask(room, { x: 4.465 }, 1)).toMatchObject({ reason: 'fence-near', urgent: false });
    expect(ask(room, { x: 4.475 }, 1)).toEqual({ factor: 0, reason: 'fence', urgent: true });
  });

  test('at the edge, nothing leads out, however slowly; turning and the way back in are free', () => {
    const edge = { x: 4.48 };
    for (const linear of [0.009, 1e-6]) {
      expect(ask(room, edge, linear)).toEqual({ factor: 0, reason: 'fence', urgent: true });
      expect(ask(room, { ...edge, yaw: null }, linear).factor).toBe(0);
      expect(ask(room, edge, -linear).factor).toBe(1);
    }
    expect(ask(room, edge, 0, 1)).toBe(FREE);
  });

  test('brakes as hard as it can if nothing else is enough, even if nothing is asked', () => {
    const fast = { x: 3.95, linear: 1 };
    for (const wish of [1, 0, -1])
      expect(ask(room, fast, wish)).toEqual({ factor: 0, reason: 'fence', urgent: true });
    expect(ask(room, { ...fast, x: 3 }, 0)).toBe(FREE);
  });

  test('turns in time on an arc that stays inside', () => {
    expect(ask(room, { x: 3.2 }, 0.5, 1.5).factor).toBeGreaterThan(ask(room, { x: 3.2 }, 0.5).factor - 0.01);
    expect(ask(room, { x: 3.9, linear: 0.3, angular: 1.5 }, 0.3, 1.5).factor).toBeGreaterThan(0.4);
  });

  test('slows in a slow area, and before it', () => {
    const fence: Fence = {
      ...room,
      slow: [{ area: { shape: 'circle', centre: [3, 0], radiusM: 1 }, maxMps: 0.2 }],
    };
    expect(ask(fence, { x: 3 }, 1)).toMatchObject({ factor: expect.closeTo(0.2), reason: 'fence-near' });
    expect(ask(fence, { x: 1 }, 1).factor).toBeGreaterThan(0.25);
    expect(ask(fence, { x: 1 }, 1).factor).toBeLessThan(1);
    expect(ask(fence, { x: 3 }, 0.2)).toBe(FREE);
    expect(ask(fence, { x: -3 }, 1)).toBe(FREE);
  });

  test.each([
    ['none yet', null],
    ['too old', { atMs: NOW - 501 }],
    ['not a number', { x: Number.NaN }],
    ['an error that is no number', { errorM: Number.NaN }],
    ['an impossible error', { errorM: -1 }],
  ])('stands without a position: %s', (_, at) => {
    expect(ask(room, at, 0.1)).toEqual({ factor: 0, reason: 'fence', urgent: true });
    expect(ask(room, at, 0, 0.1)).toEqual({ factor: 0, reason: 'fence', urgent: true });
    expect(ask(room, at, 0)).toBe(FREE);
  });

  test('a position that may be off keeps it farther away', () => {
    expect(ask(room, { x: 3.4 }, 0.5)).toBe(FREE);
    expect(ask(room, { x: 3.4, errorM: 0.8 }, 0.5).factor).toBeLessThan(0.9);
  });

  test('outside, only the way back in is free, slowly; without a direction nothing is', () => {
    const outside = { x: 7 };
    expect(ask(room, outside, 1).factor).toBe(0);
    expect(ask(room, outside, -1)).toMatchObject({ factor: expect.closeTo(0.3), reason: 'fence-near' });
    expect(ask(room, { ...outside, yaw: Math.PI }, 1).factor).toBeCloseTo(0.3);
    expect(ask(room, { ...outside, yaw: Math.PI / 2 }, 1).factor).toBe(0);
    expect(ask(room, outside, 0, 1)).toBe(FREE);
    expect(ask(room, { ...outside, yaw: null }, -1).factor).toBe(0);
  });
});
