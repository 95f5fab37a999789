import { zeroTwist } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { PoseTrack } from './pose-track.ts';

function going(linear: number, angular = 0) {
  const twist = zeroTwist();
  [twist.linear.x, twist.angular.z] = [linear, angular];
  return twist;
}

test('between two poses it is between them, the short way round', () => {
  const track = new PoseTrack();
  track.measured({ x: 0, y: 0, yaw: 3 }, going(1), 1000);
  track.measured({ x: 1, y: 2, yaw: -3 }, going(1), 1100);
  const { x, y, yaw } = track.at(1050)!;
  expect([x, y]).toEqual([0.5, 1]);
  expect(yaw).toBeCloseTo(Math.PI);
  expect(track.at(1000)).toEqual({ x: 0, y: 0, yaw: 3 });
});

test('before and after them it is carried on for a moment; then nobody knows', () => {
  const track = new PoseTrack();
  expect(track.at(1000)).toBeNull();
  track.measured({ x: 1, y: 0, yaw: 0 }, going(1), 1000);
  expect(track.at(1200)?.x).toBeCloseTo(1.2);
  expect(track.at(800)?.x).toBeCloseTo(0.8);
  expect([track.at(1301), track.at(699)]).toEqual([null, null]);
});

test('what is no number, and what is older than the last, is left out', () => {
  const track = new PoseTrack();
  track.measured({ x: 1, y: 0, yaw: 0 }, going(0), 1000);
  track.measured({ x: Number.NaN, y: 0, yaw: 0 }, going(0), 1010);
  track.measured({ x: 9, y: 0, yaw: 0 }, going(0), 990);
  expect(track.at(1005)).toEqual({ x: 1, y: 0, yaw: 0 });
});
