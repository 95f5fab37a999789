/** A robot that drives back under the real obstacle guard: people and things in its way. */
import { isZeroTwist, type Twist } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import type { MotionBound, MotionGuard } from '../motion/motion-guard.ts';
import { Footprint } from '../obstacles/footprint.ts';
import { ObstacleGuard } from '../obstacles/obstacle-guard.ts';
import { PaintedGrid } from '../obstacles/testing/painted-grid.ts';
import type { Lookout } from './return-drive.ts';
import { ReturningRobot, STEP_MS } from './testing/returning-robot.ts';

const RADIUS = 0.25;
const CLOUD_MS = 60;

/** Sensors that see everything around the robot. */
class Eyes implements Lookout, MotionGuard {
  readonly guard = new ObstacleGuard(Footprint.disc(RADIUS), 1);
  live(nowMs: number): boolean {
    return this.guard.live(nowMs);
  }
  sees(wish: Readonly<Twist>, nowMs: number): boolean {
    return this.guard.sees(wish, nowMs);
  }
  bound(wish: Readonly<Twist>, nowMs: number): Readonly<MotionBound> {
    return this.guard.bound(wish, nowMs);
  }
}

/** A robot that was driven 3 m along x and has lost its driver. */
function lost() {
  const eyes = new Eyes();
  const robot = new ReturningRobot({}, eyes);
  /** From x to x, in its way. */
  const way: { person: [number, number] | null } = { person: null };
  let steps = 0;
  const look = () => {
    const { x, y, yaw } = robot.base.pose;
    eyes.guard.moved({ x, y, yaw }, robot.velocity, robot.nowMs);
    if (++steps % (CLOUD_MS / STEP_MS) !== 0) return;
    const grid = new PaintedGrid(robot.nowMs, x, y);
    if (way.person !== null) grid.paint('occupied', ...way.person, -0.2, 0.2);
    eyes.guard.see(0, grid);
  };
  robot.onAdvance = look;
  robot.wait(0.2);
  robot.connect();
  robot.drive(0.5, 0, 6);
  robot.lose();
  return { robot, way };
}

describe('under the obstacle guard', () => {
  test('it stands before somebody in its way, goes on when the way is free, and gives up otherwise', () => {
    const { robot, way } = lost();
    way.person = [1, 1.4];
    robot.wait(26);
    expect(robot.back.phase).toBe('returning');
    expect(isZeroTwist(robot.velocity)).toBe(true);
    const gap = robot.base.pose.x - RADIUS - 1.4;
    expect(gap).toBeGreaterThan(0.05);
    expect(gap).toBeLessThan(0.4);
    way.person = null;
    robot.wait(2);
    expect(robot.velocity.linear.x).toBeLessThan(-0.15);
    way.person = [-0.4, 0];
    robot.wait(45);
    expect(robot.back.end).toBe('blocked');
    expect(robot.base.pose.x - RADIUS).toBeGreaterThan(0.05);
  });

  test('it stands when somebody steps right behind it', () => {
    const { robot, way } = lost();
    robot.wait(16);
    const { x } = robot.base.pose;
    way.person = [x - 1.2, x - 0.4];
    robot.wait(2);
    expect(isZeroTwist(robot.velocity)).toBe(true);
    expect(robot.base.pose.x - RADIUS - (x - 0.4)).toBeGreaterThan(0.05);
  });
});
