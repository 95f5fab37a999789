/** What the obstacle guard does where nobody can tell where the robot or a sensor is. */
import { zeroTwist } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { Footprint } from './footprint.ts';
import { ObstacleGuard } from './obstacle-guard.ts';
import { PaintedGrid } from './testing/painted-grid.ts';

const AHEAD = { ...zeroTwist(), linear: { x: 1, y: 0, z: 0 } };
const HERE = { x: 0, y: 0, yaw: 0 };
const UNSEEN_MPS = 0.3;

function guardOf(odometry = true, sensors = 1): ObstacleGuard {
  return new ObstacleGuard(Footprint.disc(0.25), sensors, { odometry, unseenMps: UNSEEN_MPS });
}
const wallAt = (ms: number, x = 1, placed = true) => {
  const grid = new PaintedGrid(ms).paint('occupied', x, 4, -2, 2);
  grid.placed = placed;
  return grid;
};

test('after a jump, what was seen before is forgotten, and the sensors are silent until they see something newer', () => {
  const guard = guardOf();
  guard.moved(HERE, zeroTwist(), 1000);
  guard.see(0, wallAt(1000, 0.6));
  expect(guard.bound(AHEAD, 1010).reason).toBe('obstacle-near');
  guard.jumped(1050);
  guard.moved({ x: 1.2, y: 0, yaw: 0 }, zeroTwist(), 1050);
  expect(guard.bound(AHEAD, 1060)).toMatchObject({ factor: UNSEEN_MPS, reason: 'sensor-silent' });
  // A cloud that was taken before it was placed by a pose from before.
  guard.see(0, new PaintedGrid(1040));
  expect(guard.bound(AHEAD, 1060).reason).toBe('sensor-silent');
  guard.see(0, new PaintedGrid(1060, 1.2));
  expect(guard.bound(AHEAD, 1070)).toMatchObject({ factor: 1, reason: null });
});

test('a map that lies around the robot does not care about its pose', () => {
  const guard = guardOf(false);
  guard.see(0, wallAt(1000, 0.6, false));
  guard.jumped(1050);
  expect(guard.bound(AHEAD, 1060).reason).toBe('obstacle-near');
});

test('while those who say where a sensor sits contradict each other, the robot stands', () => {
  const guard = guardOf(true, 2);
  guard.moved(HERE, zeroTwist(), 1000);
  guard.see(0, new PaintedGrid(1000));
  guard.see(1, new PaintedGrid(1000));
  expect(guard.bound(AHEAD, 1010).factor).toBe(1);
  guard.see(1, Object.assign(new PaintedGrid(1010), { disputed: true }));
  expect(guard.bound(AHEAD, 1020)).toEqual({ factor: 0, reason: 'sensor-silent', urgent: true });
  // Silence does not settle it.
  expect(guard.bound(AHEAD, 9000).factor).toBe(0);
  expect(guard.bound(zeroTwist(), 9000).factor).toBe(1);
  for (const sensor of [0, 1]) guard.see(sensor, new PaintedGrid(9000));
  guard.moved(HERE, zeroTwist(), 9000);
  expect(guard.bound(AHEAD, 9010).factor).toBe(1);
});

test('a robot whose odometry is missing is slow, and still stops before what its sensors see', () => {
  const guard = guardOf();
  guard.see(0, wallAt(1000, 3, false));
  expect(guard.bound(AHEAD, 1010)).toMatchObject({ factor: UNSEEN_MPS, reason: 'sensor-silent' });
  guard.see(0, wallAt(1100, 0.3, false));
  expect(guard.bound(AHEAD, 1110).factor).toBe(0);
  // Where nothing is to say it, that is no matter.
  const without = guardOf(false);
  without.see(0, wallAt(1000, 3, false));
  expect(without.bound(AHEAD, 1010).factor).toBe(1);
});

test('odometry that is not believed counts as silent at once', () => {
  const guard = guardOf();
  guard.moved(HERE, zeroTwist(), 1000);
  guard.see(0, new PaintedGrid(1000));
  expect(guard.bound(AHEAD, 1010).factor).toBe(1);
  guard.lost();
  expect(guard.bound(AHEAD, 1010)).toMatchObject({ factor: UNSEEN_MPS, reason: 'sensor-silent' });
  expect(guard.live(1010)).toBe(false);
  guard.moved(HERE, zeroTwist(), 1020);
  expect(guard.bound(AHEAD, 1030).factor).toBe(1);
});
