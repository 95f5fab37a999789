import { longProperty } from '@farpoint/network-sim/cases';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { Unicycle } from './testing/unicycle.ts';
import { Track } from './track.ts';
import { TrackFollower } from './track-follower.ts';

const STEP_MS = 40;
const limits = { maxLinear: 0.2, maxAngular: 0.5, toleranceM: 0.3 };
type Leg = readonly [linear: number, angular: number, seconds: number];

function driven(legs: readonly Leg[]) {
  const track = new Track({ maxM: 50, mostMps: 1.5, mostRadps: 3 });
  const robot = new Unicycle();
  let nowMs = 1000;
  const seen = [robot.pose];
  const advance = (x: number, z: number, lays: boolean) => {
    const zero = { x: 0, y: 0, z: 0 };
    robot.go({ linear: { ...zero, x }, angular: { ...zero, z } }, STEP_MS / 1000);
    nowMs += STEP_MS;
    track.note(robot.pose, nowMs, lays);
  };
  track.note(robot.pose, nowMs);
  for (const [x, z, seconds] of legs)
    for (let t = 0; t < seconds * 1000; t += STEP_MS) {
      advance(x, z, true);
      seen.push(robot.pose);
    }
  const follower = new TrackFollower(track, limits);
  /** @returns how it ended, and how far the robot was from where it had been, at most */
  const goBack = (disturb: (pose: Unicycle) => void = () => undefined) => {
    track.begin();
    let worst = 0;
    let reverse = 0;
    for (let step = 0; step < 10_000; step++) {
      disturb(robot);
      const wish = follower.step(robot.pose);
      if (typeof wish === 'string') return { end: wish, worst, reverse };
      expect(Math.abs(wish.linear.x)).toBeLessThanOrEqual(limits.maxLinear + 1e-9);
      expect(Math.abs(wish.angular.z)).toBeLessThanOrEqual(limits.maxAngular + 1e-9);
      if (wish.linear.x < 0) reverse++;
      advance(wish.linear.x, wish.angular.z, false);
      const { x, y } = robot.pose;
      worst = Math.max(worst, Math.min(...seen.map((was) => Math.hypot(was.x - x, was.y - y))));
    }
    return { end: 'never', worst, reverse };
  };
  return { track, robot, goBack };
}

describe('following a track back', () => {
  test.each<[string, Leg[]]>([
    ['straight on', [[0.8, 0, 5]]],
    [
      'a bend',
      [
        [0.6, 0, 3],
        [0.4, 0.8, 2],
        [0.6, 0, 3],
        [0.4, -0.8, 2],
        [0.6, 0, 2],
      ],
    ],
    [
      'a turn about on the spot',
      [
        [0.5, 0, 3],
        [0, -1, 3],
        [0.5, 0, 2],
      ],
    ],
    [
      'a turn in three steps',
      [
        [0.5, 0, 3],
        [0.3, 0.9, 1.7],
        [-0.3, 0.9, 1.8],
        [0.5, 0, 3],
      ],
    ],
  ])('%s', (_, legs) => {
    const { robot, goBack } = driven(legs);
    const { end, worst, reverse } = goBack();
    expect(end).toBe('arrived');
    expect(worst).toBeLessThan(0.1);
    expect(reverse).toBeGreaterThan(10);
    expect(Math.hypot(robot.pose.x, robot.pose.y)).toBeLessThan(0.1);
  });

  test('what was driven in reverse is driven forwards', () => {
    const { robot, goBack } = driven([[-0.5, 0, 4]]);
    expect(goBack()).toMatchObject({ end: 'arrived', reverse: 0 });
    expect(Math.abs(robot.pose.x)).toBeLessThan(0.05);
  });

  test('a robot that drifts is led back to its track', () => {
    const { goBack } = driven([[0.5, 0, 8]]);
    const back = goBack((robot) => {
      robot.pose = { ...robot.pose, yaw: robot.pose.yaw + 0.002 };
    });
    expect(back.end).toBe('arrived');
    expect(back.worst).toBeLessThan(0.15);
  });

  test('gives up when the robot is pushed off its track', () => {
    const { robot, goBack } = driven([[0.5, 0, 8]]);
    let pushed = false;
    const { end } = goBack((pushedRobot) => {
      if (pushed || robot.pose.x > 3) return;
      pushed = true;
      pushedRobot.pose = { ...pushedRobot.pose, y: 0.31 };
    });
    expect(end).toBe('off-track');
    expect(robot.pose.x).toBeGreaterThan(2.9);
  });

  describe('along any way that a driver may take', () => {
    const ends = { arrived: 0, others: 0 };

    test('it never leaves its track', () => {
      const leg = fc.tuple(
        fc.constantFrom(0, 0, 0.3, 0.5, 0.8, -0.3),
        fc.constantFrom(0, 0, 0.3, -0.5, 1, -1.5),
        fc.double({ min: 0.3, max: 3, noNaN: true }),
      );
      fc.assert(
        fc.property(fc.array(leg, { minLength: 1, maxLength: 12 }), (legs) => {
          const { robot, goBack } = driven(legs);
          const { end, worst } = goBack();
          expect(worst).toBeLessThan(limits.toleranceM);
          expect(end).not.toBe('never');
          if (end !== 'arrived') ends.others++;
          else {
            ends.arrived++;
            expect(Math.hypot(robot.pose.x, robot.pose.y)).toBeLessThan(0.2);
          }
        }),
        longProperty(19, 300),
      );
    });

    test('and comes to its beginning', () => {
      expect(ends.others).toBeLessThan(0.02 * ends.arrived);
    });
  });
});
