import { RobotWorld } from '@farpoint/cloud-view';
import { Object3D, OrthographicCamera, PerspectiveCamera } from 'three';
import { expect, test } from 'vitest';
import { bearingOnScreen } from './blocked-edge.ts';

/** A robot in its world with REP-103 axes, as the scene turns it. */
function robot(yaw: number): Object3D {
  const [world, body] = [new RobotWorld(), new Object3D()];
  body.rotation.z = yaw;
  world.add(body);
  world.updateMatrixWorld(true);
  return body;
}

test('who looks where the robot looks has ahead up and left left, however far down they look', () => {
  for (const pitch of [0, -0.8, 0.4]) {
    const camera = new PerspectiveCamera();
    camera.rotation.set(pitch, 0.7, 0, 'YXZ');
    camera.updateMatrixWorld();
    for (const bearing of [0, 1, Math.PI / 2, -2, 3])
      expect(bearingOnScreen(bearing, robot(0.7), camera, false)).toBeCloseTo(bearing);
  }
});

test('who looks to the left has what is ahead at the right', () => {
  const camera = new PerspectiveCamera();
  camera.rotation.set(0, Math.PI / 2, 0, 'YXZ');
  camera.updateMatrixWorld();
  expect(bearingOnScreen(0, robot(0), camera, false)).toBeCloseTo(-Math.PI / 2);
});

test('from above with north up, it is where it is on the map', () => {
  const camera = new OrthographicCamera();
  camera.rotation.set(-Math.PI / 2, Math.PI / 2, 0, 'YXZ');
  camera.updateMatrixWorld();
  // The robot looks east: to the right.
  expect(bearingOnScreen(0, robot(0), camera, true)).toBeCloseTo(-Math.PI / 2);
  expect(bearingOnScreen(0, robot(Math.PI / 2), camera, true)).toBeCloseTo(0);
});
