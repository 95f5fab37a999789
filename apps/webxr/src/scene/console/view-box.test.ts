import { expect, test } from 'vitest';
import { covers, MENU_HALF, menuYaw, ViewBox, WAY_AHEAD } from './view-box.ts';

const RADIAN = Math.PI / 180;
const eyes = { x: 1, y: 1.6, z: 2 };

test('a box has the angles of its points, seen from the head and from ahead', () => {
  const box = new ViewBox();
  expect(box.isEmpty).toBe(true);
  box.add({ x: 2, y: 1.6, z: 1 }, eyes, 0);
  expect([box.left, box.right, box.bottom, box.top].map(Math.round)).toEqual([45, 45, 0, 0]);
  box.add({ x: 1, y: 0.6, z: 1 }, eyes, 0);
  expect([box.left, box.right, box.bottom, box.top].map(Math.round)).toEqual([0, 45, -45, 0]);
  box.clear();
  // Whose way ahead is to the left has it farther to the right.
  box.add({ x: 2, y: 1.6, z: 1 }, eyes, 45 * RADIAN);
  expect(Math.round(box.left)).toBe(90);
});

test('boxes cover each other only where both angles do, and an empty one covers nothing', () => {
  const low = { left: -18, right: 18, bottom: -40, top: -18 };
  expect(covers(low, WAY_AHEAD)).toBe(false);
  expect(covers({ ...low, top: -10 }, WAY_AHEAD)).toBe(true);
  expect(covers({ ...low, left: 20, right: 40, top: 0 }, WAY_AHEAD)).toBe(false);
  expect(covers(new ViewBox(), WAY_AHEAD)).toBe(false);
});

test('wherever the face points, the menu is beside it and does not cover the way ahead', () => {
  for (let face = -180; face < 180; face += 3) {
    for (const ahead of [0, 170, -90]) {
      const yaw = menuYaw(face * RADIAN, ahead * RADIAN);
      const from = (angle: number) => {
        const turned = ((((angle + 180) % 360) + 360) % 360) - 180;
        return Math.abs(turned);
      };
      expect(from(yaw / RADIAN - ahead)).toBeGreaterThanOrEqual(WAY_AHEAD.right + MENU_HALF - 1e-9);
      expect(from(yaw / RADIAN - face)).toBeGreaterThan(MENU_HALF + 15);
      expect(from(yaw / RADIAN - face)).toBeLessThan(46);
    }
  }
  // A face that points nearly ahead has it always on the same side.
  for (const face of [-10, -1, 0, 1, 10]) expect(menuYaw(face * RADIAN, 0)).toBeGreaterThan(0);
});
