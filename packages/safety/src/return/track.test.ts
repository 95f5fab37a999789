import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { Unicycle } from './testing/unicycle.ts';
import { Track } from './track.ts';

const STEP_MS = 20;

function tracked(maxM = 20) {
  const track = new Track({ maxM, mostMps: 1.5, mostRadps: 3 });
  const robot = new Unicycle();
  let nowMs = 1000;
  const drive = (x: number, z: number, seconds: number) => {
    for (let t = 0; t < seconds * 1000 - 1e-6; t += STEP_MS) {
      const zero = { x: 0, y: 0, z: 0 };
      robot.go({ linear: { ...zero, x }, angular: { ...zero, z } }, STEP_MS / 1000);
      nowMs += STEP_MS;
      track.note(robot.pose, nowMs);
    }
  };
  track.note(robot.pose, nowMs);
  return { track, robot, drive, wait: (ms: number) => (nowMs += ms), now: () => nowMs };
}

describe('the track', () => {
  test('has a crumb every 10 cm, and where the robot turns', () => {
    const { track, drive } = tracked();
    drive(0.55, 0, 2);
    expect(track.crumbs.length).toBe(11);
    drive(0, 1.05, 1);
    expect(track.crumbs.length).toBe(16);
    expect(track.lengthM).toBeCloseTo(1.1, 2);
  });

  test('forgets what is longer ago than its length', () => {
    const { track, drive } = tracked(2);
    drive(1, 0, 10);
    expect(track.lengthM).toBeLessThanOrEqual(2);
    expect(track.lengthM).toBeGreaterThan(1.8);
    expect(track.crumbs[0]?.x).toBeGreaterThan(7.9);
  });

  test('forgets a way that the robot has gone back by itself', () => {
    const { track, drive } = tracked();
    drive(0.5, 0, 4);
    drive(-0.5, 0, 2);
    expect(track.lengthM).toBeCloseTo(1, 1);
  });

  test('forgets a loop', () => {
    const { track, drive } = tracked();
    drive(0.5, 0, 2);
    // A circle of 3.1 m.
    drive(0.5, 1, 2 * Math.PI);
    drive(0.5, 0, 2);
    expect(track.lengthM).toBeLessThan(2.3);
  });

  test('begins anew when the pose jumps', () => {
    const { track, robot, drive } = tracked();
    drive(0.5, 0, 2);
    robot.pose = { ...robot.pose, y: 0.4 };
    drive(0.5, 0, 0.02);
    expect(track.crumbs.length).toBe(1);
    drive(0.5, 0, 1);
    expect(track.crumbs.length).toBe(6);
    robot.pose = { ...robot.pose, yaw: robot.pose.yaw + 1 };
    drive(0.5, 0, 0.02);
    expect(track.crumbs.length).toBe(1);
  });

  test('begins anew after odometry was silent', () => {
    const { track, drive, wait } = tracked();
    drive(0.55, 0, 2);
    wait(900);
    drive(0.55, 0, 0.2);
    expect(track.crumbs.length).toBe(12);
    wait(1100);
    drive(0.55, 0, 0.2);
    expect(track.crumbs.length).toBe(1);
  });

  test('takes no pose that is none, nor one that is not newer', () => {
    const { track, drive, now } = tracked();
    drive(0.5, 0, 1);
    const { pose, atMs } = track;
    track.note({ x: Number.NaN, y: 0, yaw: 0 }, now() + 20);
    track.note({ x: 0, y: 0, yaw: 0 }, now() - 20);
    expect(track.pose).toBe(pose);
    expect(track.atMs).toBe(atMs);
  });

  test('is bounded, whatever the robot does', () => {
    const leg = fc.tuple(
      fc.double({ min: -1, max: 1, noNaN: true }),
      fc.double({ min: -2, max: 2, noNaN: true }),
    );
    fc.assert(
      fc.property(fc.array(leg, { minLength: 5, maxLength: 40 }), (legs) => {
        const { track, robot, drive } = tracked(3);
        for (const [x, z] of legs) drive(x, z, 1);
        expect(track.lengthM).toBeLessThanOrEqual(3.1);
        expect(track.crumbs.length).toBeLessThanOrEqual(61);
        const newest = track.crumbs.at(-1);
        expect(Math.hypot(robot.pose.x - (newest?.x ?? 9), robot.pose.y - (newest?.y ?? 9))).toBeLessThan(
          0.13,
        );
      }),
      { seed: 19, numRuns: 60 },
    );
  });
});
