import { Random } from '@farpoint/network-sim';
import { expect, test } from 'vitest';
import type { BaseMotion } from './base-model.ts';
import { MOST_CORRECTION_M, MOST_CORRECTION_RAD, ReconciledPose } from './reconciled-pose.ts';

const FRAME_MS = 1000 / 60;

/** Drives along x at 1 m/s; what is believed of it is off by so much. */
function source() {
  return {
    jumps: 0,
    offM: 0,
    offRad: 0,
    poseAt(atMs: number, into: BaseMotion) {
      into.x = atMs / 1000 + this.offM;
      into.y = 0;
      into.yaw = this.offRad;
    },
  };
}

test('moves as the prediction does, also in the frame in which it is corrected', () => {
  const robot = source();
  const pose = new ReconciledPose();
  pose.follow(robot, 0);
  pose.follow(robot, FRAME_MS);
  expect(pose.x).toBeCloseTo(FRAME_MS / 1000, 9);
  robot.offM = 0.05;
  pose.follow(robot, 2 * FRAME_MS);
  expect(pose.x - FRAME_MS / 1000).toBeCloseTo(FRAME_MS / 1000 + pose.correctedM, 9);
  expect(pose.correctedM).toBeGreaterThan(0);
  for (let i = 3; i < 60; i++) pose.follow(robot, i * FRAME_MS);
  expect(pose.x).toBeCloseTo((59 * FRAME_MS) / 1000 + 0.05, 3);
});

test('no frame corrects more than 3 cm and 2°, whatever comes', () => {
  const random = new Random(3, 1);
  const robot = source();
  const pose = new ReconciledPose();
  let [atMs, x, yaw] = [0, 0, 0];
  pose.follow(robot, atMs);
  for (let i = 0; i < 2000; i++) {
    if (random.chance(0.2)) robot.offM = random.next() - 0.5;
    if (random.chance(0.2)) robot.offRad = random.next() - 0.5;
    const elapsedMs = 5 + 60 * random.next();
    [atMs, x, yaw] = [atMs + elapsedMs, pose.x, pose.yaw];
    pose.follow(robot, atMs);
    expect(Math.abs(pose.x - x - elapsedMs / 1000)).toBeLessThanOrEqual(MOST_CORRECTION_M + 1e-9);
    expect(Math.abs(pose.yaw - yaw)).toBeLessThanOrEqual(MOST_CORRECTION_RAD + 1e-9);
  }
});

test('a jump of the robot, a pause of the page and a reset apply at once', () => {
  const robot = source();
  const pose = new ReconciledPose();
  pose.follow(robot, 0);
  robot.offM = 1;
  robot.jumps++;
  pose.follow(robot, FRAME_MS);
  expect(pose.x).toBeCloseTo(1 + FRAME_MS / 1000, 9);
  robot.offM = 0;
  pose.follow(robot, 2000);
  expect(pose.x).toBeCloseTo(2, 9);
  robot.offM = 1;
  pose.reset();
  pose.follow(robot, 2010);
  expect(pose.x).toBeCloseTo(3.01, 9);
});
