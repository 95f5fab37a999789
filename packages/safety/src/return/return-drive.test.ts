import { isZeroTwist } from '@farpoint/protocol';
import { describe, expect, test } from 'vitest';
import { FREE } from '../motion/motion-guard.ts';
import type { ReturnOptions } from './return-options.ts';
import { ReturningRobot } from './testing/returning-robot.ts';

/** A robot that was driven 3 m, and has lost its driver. */
function lost(options: Partial<ReturnOptions> = {}): ReturningRobot {
  const robot = new ReturningRobot(options);
  robot.connect();
  robot.drive(0.5, 0, 6);
  robot.lose();
  return robot;
}

/** The same, on its way back. */
function returning(options: Partial<ReturnOptions> = {}): ReturningRobot {
  const robot = lost(options);
  robot.wait(15);
  expect(robot.back.phase).toBe('returning');
  expect(robot.velocity.linear.x).toBeCloseTo(-0.2);
  return robot;
}

function ends(robot: ReturningRobot, end: string): void {
  expect(robot.back.phase).toBe('ended');
  expect(robot.back.end).toBe(end);
  robot.wait(0.1);
  expect(isZeroTwist(robot.velocity)).toBe(true);
  const { x } = robot.base.pose;
  robot.wait(60);
  expect(robot.base.pose.x).toBe(x);
}

/** Nothing takes its velocities, or no odometry comes, for so long. */
function spoiledFor(robot: ReturningRobot, what: 'wheels' | 'odometry', seconds: number): void {
  robot[what] = false;
  robot.wait(seconds);
  robot[what] = true;
}

function moved(base: ReturningRobot['base'], x: number, y: number): void {
  base.pose = { ...base.pose, x: base.pose.x + x, y: base.pose.y + y };
}

/** It is moved so far in each of so many steps. */
function pushed(robot: ReturningRobot, steps: number, x: number, y: number): void {
  for (let i = 0; i < steps; i++) {
    moved(robot.base, x, y);
    robot.advance();
  }
}

function pinnedFor(robot: ReturningRobot, seconds: number): void {
  const { pose } = robot.base;
  robot.onAdvance = () => {
    robot.base.pose = pose;
  };
  robot.wait(seconds);
}

describe('a robot that has lost its operators', () => {
  test('waits, says what it will do, and comes back to where it was first driven', () => {
    const robot = lost();
    const { x } = robot.base.pose;
    expect(x).toBeGreaterThan(2.7);
    robot.wait(2);
    expect(robot.back.phase).toBe('waiting');
    expect(robot.back.told).toBe(undefined);
    robot.wait(8.1);
    expect(robot.back.phase).toBe('announcing');
    expect(robot.back.told).toEqual({ phase: 'announcing', metres: 0 });
    robot.wait(2.9);
    expect(robot.base.pose.x).toBe(x);
    robot.wait(1);
    expect(robot.back.phase).toBe('returning');
    expect(robot.motion.decision).toEqual({ phase: 'driving', factor: 1, reasons: [] });
    robot.wait(20);
    ends(robot, 'track-end');
    expect(Math.abs(robot.base.pose.x)).toBeLessThan(0.1);
    expect(robot.back.metres).toBeCloseTo(x, 1);
    expect(robot.back.told).toEqual({ phase: 'ended', metres: robot.back.metres, end: 'track-end' });
  });

  test('stays if nobody has driven it', () => {
    const robot = new ReturningRobot();
    robot.connect();
    robot.wait(1);
    robot.lose();
    robot.wait(60);
    expect(robot.back.phase).toBe('standby');
  });

  test('stays as long as any operator is heard', () => {
    const robot = lost();
    for (let i = 0; i < 8; i++) {
      robot.wait(9);
      robot.back.heard(robot.nowMs);
    }
    expect(robot.back.phase).toBe('standby');
    robot.wait(10.1);
    expect(robot.back.phase).toBe('announcing');
  });

  test('goes no farther than it is allowed to', () => {
    const robot = lost({ maxM: 1 });
    const { x } = robot.base.pose;
    robot.wait(30);
    ends(robot, 'track-end');
    expect(x - robot.base.pose.x).toBeGreaterThan(0.8);
    expect(x - robot.base.pose.x).toBeLessThan(1.05);
  });

  test('does it once for each drive', () => {
    const robot = returning();
    robot.back.heard(robot.nowMs);
    robot.advance();
    ends(robot, 'service-back');
    robot.connect();
    robot.wait(1);
    robot.lose();
    robot.wait(60);
    expect(robot.back.phase).toBe('ended');
    robot.connect();
    robot.drive(0.5, 0, 1);
    expect(robot.back.told).toBe(undefined);
    robot.lose();
    robot.wait(15);
    expect(robot.back.phase).toBe('returning');
  });
});

describe('a driver who has left on purpose', () => {
  test.each([0, 5])('is no reason to drive back, %i s after it was heard last', (afterS) => {
    const robot = lost();
    robot.wait(afterS);
    robot.back.left(robot.nowMs);
    robot.wait(60);
    expect(robot.back.phase).toBe('standby');
  });

  test('does not end a way back that silence has begun, nor forbid the next', () => {
    const robot = returning();
    robot.back.left(robot.nowMs);
    robot.advance();
    expect(robot.back.phase).toBe('returning');
  });
});

describe('it stands at once', () => {
  test('when an operator is heard, also while it only announces', () => {
    const robot = returning();
    robot.back.heard(robot.nowMs);
    robot.advance();
    expect(robot.velocity.linear.x).toBeGreaterThan(-0.15);
    ends(robot, 'service-back');
    const announcing = lost();
    announcing.wait(11);
    announcing.back.heard(announcing.nowMs);
    ends(announcing, 'service-back');
  });

  test('at the emergency stop, and its release moves nothing', () => {
    const robot = returning();
    robot.guard.holdEstop('key');
    robot.wait(0.1);
    robot.guard.letGoEstop('key');
    ends(robot, 'estop');
    const waiting = lost();
    waiting.wait(5);
    waiting.guard.holdEstop('key');
    waiting.wait(0.1);
    waiting.guard.letGoEstop('key');
    waiting.wait(60);
    expect(waiting.back.phase).toBe('standby');
  });

  test.each<[string, string, (robot: ReturningRobot) => void]>([
    [
      'when somebody takes the lease',
      'service-back',
      ({ guard, nowMs }) => void guard.requestLease('other', false, nowMs),
    ],
    ['when nothing takes the velocities', 'no-wheels', (robot) => spoiledFor(robot, 'wheels', 0.02)],
    ['when odometry says nothing', 'odometry-silent', (robot) => spoiledFor(robot, 'odometry', 0.4)],
    ['when odometry says something else', 'off-track', ({ base }) => moved(base, -base.pose.x, 0)],
    ['when it is pushed off its track', 'off-track', (robot) => pushed(robot, 20, 0, 0.02)],
    ['when its wheels do not move it', 'blocked', (robot) => pinnedFor(robot, 21)],
  ])('%s', (_, end, happens) => {
    const robot = returning();
    happens(robot);
    robot.advance();
    ends(robot, end);
  });

  test('when a sensor says nothing, and goes on when it does', () => {
    const robot = returning();
    robot.lookout.isLive = false;
    robot.wait(0.1);
    expect(isZeroTwist(robot.velocity)).toBe(true);
    robot.lookout.isLive = true;
    robot.wait(1);
    expect(robot.velocity.linear.x).toBeCloseTo(-0.2);
    robot.lookout.isLive = false;
    robot.wait(21);
    ends(robot, 'sensor-silent');
  });

  test('where no sensor sees, unless it is told otherwise', () => {
    const robot = returning();
    robot.lookout.isSeen = false;
    robot.wait(0.1);
    expect(isZeroTwist(robot.velocity)).toBe(true);
    robot.wait(21);
    ends(robot, 'unseen');
    const bold = returning({ unseen: 'slow' });
    bold.lookout.isSeen = false;
    bold.wait(1);
    expect(bold.velocity.linear.x).toBeCloseTo(-0.2);
  });

  test('before somebody in the way; it goes on when the way is free, and gives up after a while', () => {
    const robot = returning();
    robot.lookout.says = { factor: 0, reason: 'obstacle', urgent: true };
    robot.wait(10);
    expect(isZeroTwist(robot.velocity)).toBe(true);
    expect(robot.motion.decision).toMatchObject({ phase: 'held', reasons: ['obstacle'] });
    robot.lookout.says = FREE;
    robot.wait(1);
    expect(robot.velocity.linear.x).toBeCloseTo(-0.2);
    robot.lookout.says = { factor: 0, reason: 'obstacle', urgent: true };
    robot.wait(21);
    ends(robot, 'blocked');
  });

  test.each([
    [0.04, 'ended', 'blocked'],
    [0.06, 'returning', null],
  ])('when it gets on by less than 5 cm in 20 s: after %f m it is %s', (metres, phase, end) => {
    const robot = lost();
    let { pose } = robot.base;
    robot.onAdvance = () => {
      robot.base.pose = pose;
    };
    robot.wait(25);
    pose = { ...pose, x: pose.x - metres };
    robot.wait(10);
    expect([robot.back.phase, robot.back.end]).toEqual([phase, end]);
  });

  test('when it was on its way for too long', () => {
    const robot = lost({ longestMs: 5000 });
    robot.wait(18.2);
    ends(robot, 'too-long');
  });
});

describe('it does not begin', () => {
  test.each<[string, string, (robot: ReturningRobot) => void]>([
    [
      'while a sensor is silent',
      'sensor-silent',
      ({ lookout }) => void Object.assign(lookout, { isLive: false }),
    ],
    ['without odometry', 'odometry-silent', (robot) => void Object.assign(robot, { odometry: false })],
    [
      'while nothing takes the velocities',
      'no-wheels',
      (robot) => void Object.assign(robot, { wheels: false }),
    ],
    ['after something else has moved it', 'moved', (robot) => pushed(robot, 200, 0.001, 0)],
    ['without a track', 'no-track', ({ base }) => moved(base, 90 - base.pose.x, 0)],
  ])('%s', (_, end, spoil) => {
    const robot = lost();
    spoil(robot);
    robot.wait(15);
    ends(robot, end);
    expect(robot.back.metres).toBe(0);
  });

  test.each([
    [0.17, 'ended', 'no-track'],
    [0.25, 'announcing', null],
  ])('unless it knows a way of 0.2 m: after %f m it is %s', (metres, phase, end) => {
    const robot = new ReturningRobot();
    robot.connect();
    robot.hand = { x: 0.1, z: 0 };
    while (robot.base.pose.x < metres - 0.01) robot.advance();
    robot.drive(0, 0, 0.1);
    expect(robot.base.pose.x).toBeCloseTo(metres, 1.5);
    robot.lose();
    robot.wait(12);
    expect([robot.back.phase, robot.back.end]).toEqual([phase, end]);
  });
});
