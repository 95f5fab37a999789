import { worldToThree } from '@farpoint/cloud-view';
import fc from 'fast-check';
import { Vector3 } from 'three';
import { describe, expect, test } from 'vitest';
import { TopDownCamera, type TopDownLook } from './top-down-camera.ts';

const robot = { x: 3, y: -2, z: 0.5, yaw: 0.7 };

/** Where a point of the robot's world is on the screen: −1…1, to the right and up. */
function onScreen(look: TopDownLook, x: number, y: number, z: number, at = robot): [number, number] {
  const view = new TopDownCamera();
  view.place(at, look);
  const point = new Vector3(x, y, z).applyMatrix4(worldToThree()).project(view.camera);
  expect(Math.abs(point.z)).toBeLessThan(1);
  return [point.x, point.y];
}

function expectAt([x, y]: [number, number], wantedX: number, wantedY: number): void {
  expect(x).toBeCloseTo(wantedX, 6);
  expect(y).toBeCloseTo(wantedY, 6);
}

describe('TopDownCamera', () => {
  const wide = { reach: 5, aspect: 2 };

  test('shows the robot in the middle, wherever it is and at whatever height', () => {
    const metres = fc.double({ min: -500, max: 500, noNaN: true });
    const angle = fc.double({ min: -10, max: 10, noNaN: true });
    fc.assert(
      fc.property(metres, metres, metres, angle, fc.boolean(), (x, y, z, yaw, headingUp) => {
        expectAt(onScreen({ ...wide, headingUp }, x, y, z, { x, y, z, yaw }), 0, 0);
        // A ceiling above the robot is at the same place.
        expectAt(onScreen({ ...wide, headingUp }, x, y, z + 20, { x, y, z, yaw }), 0, 0);
      }),
      { seed: 4 },
    );
  });

  test('heading up: what is ahead is up, what is on the left is left', () => {
    const { x, y, z, yaw } = robot;
    const look = { ...wide, headingUp: true };
    const [ahead, left] = [yaw, yaw + Math.PI / 2];
    expectAt(onScreen(look, x + 5 * Math.cos(ahead), y + 5 * Math.sin(ahead), z), 0, 1);
    expectAt(onScreen(look, x + 10 * Math.cos(left), y + 10 * Math.sin(left), z), -1, 0);
  });

  test('north up: y is up and x is to the right, whatever the heading', () => {
    const look = { ...wide, headingUp: false };
    expectAt(onScreen(look, robot.x, robot.y + 5, robot.z), 0, 1);
    expectAt(onScreen(look, robot.x + 10, robot.y, robot.z), 1, 0);
  });

  test('on an upright screen the reach is to the sides', () => {
    const look = { reach: 5, aspect: 0.5, headingUp: false };
    expectAt(onScreen(look, robot.x + 5, robot.y, robot.z), 1, 0);
    expectAt(onScreen(look, robot.x, robot.y + 10, robot.z), 0, 1);
  });
});
