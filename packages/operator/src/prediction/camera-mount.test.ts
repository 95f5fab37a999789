import { expect, test } from 'vitest';
import { CameraMount } from './camera-mount.ts';

/** The body drives on a circle of 2 m; the camera is 0.2 m ahead, 0.1 m to the left, 1 m up, turned by 0.3. */
function bodyAt(ms: number) {
  const yaw = ms / 2000;
  return { x: 2 * Math.sin(yaw), y: 2 - 2 * Math.cos(yaw), z: 0.05, yaw };
}

function cameraAt(ms: number) {
  const { x, y, z, yaw } = bodyAt(ms);
  const [cos, sin] = [Math.cos(yaw), Math.sin(yaw)];
  return { x: x + 0.2 * cos - 0.1 * sin, y: y + 0.2 * sin + 0.1 * cos, z: z + 1, yaw: yaw + 0.3 };
}

test('is found while the robot drives, from poses of different instants, and places the camera', () => {
  const mount = new CameraMount();
  for (let ms = 0; ms < 4000; ms += 10) {
    // Clouds come before or after the telemetry of their instant.
    if (ms % 30 === 0) mount.onCamera(ms, cameraAt(ms));
    const { x, y, z, yaw } = bodyAt(ms);
    if (ms % 50 === 0) mount.onBody(ms, x, y, z, yaw);
  }
  expect(mount.known).toBe(true);
  const [forward, left, up, turn] = [mount.forward, mount.left, mount.up, mount.turn];
  expect([forward, left, up, turn].map((value) => Math.round(value * 100) / 100)).toEqual([0.2, 0.1, 1, 0.3]);
  const into = { x: 0, y: 0, z: 0, yaw: 0 };
  const { x, y, z, yaw } = bodyAt(5000);
  mount.place(x, y, z, yaw, into);
  const camera = cameraAt(5000);
  for (const key of ['x', 'y', 'z', 'yaw'] as const) expect(into[key]).toBeCloseTo(camera[key], 2);
});

test('is not known of a camera that does not move with the body', () => {
  const mount = new CameraMount();
  for (let ms = 0; ms < 4000; ms += 50) {
    mount.onBody(ms, 0, 0, 0, 0);
    mount.onCamera(ms, cameraAt(ms));
  }
  expect(mount.known).toBe(false);
});

test('poses from before the history and poses that are no numbers are passed over', () => {
  const mount = new CameraMount();
  mount.onBody(1000, 0, 0, 0, 0);
  mount.onBody(1050, 0, 0, 0, 0);
  mount.onCamera(10, { x: 5, y: 5, z: 5, yaw: 0 });
  for (let i = 0; i < 20; i++) mount.onCamera(1020, { x: 0.1, y: 0, z: 1, yaw: Number.NaN });
  expect(mount.known).toBe(false);
  for (let i = 0; i < 20; i++) mount.onCamera(1020, { x: 0.1, y: 0, z: 1, yaw: 0 });
  expect(mount.known).toBe(true);
  mount.reset();
  expect(mount.known).toBe(false);
});
