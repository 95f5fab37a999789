import { describe, expect, test } from 'vitest';
import { robotOf } from './testing/robot-of.ts';

const ros = (pose: string, more = '') => `robot:
  source: { kind: ros2 }
  sink: { kind: ros2 }
  topics:
    - { topic: /points, as: cloud }
    - { topic: /odom, as: pose, type: ${pose} }
    - { topic: /cmd_vel, as: velocity }
  guard: { mount: "0.1,0,0.9,0,0.2,0" }
  return: { enabled: true${more} }`;

describe('a robot that drives back by itself', () => {
  test('does so only if it is told to', () => {
    expect(robotOf([]).returns).toBe(undefined);
    expect(robotOf(['--return']).returns).toEqual({
      options: {
        ...{ afterMs: 10_000, announceMs: 3000, maxM: 20, maxLinear: 0.2, maxAngular: 0.5 },
        ...{ toleranceM: 0.3, blockedMs: 20_000, longestMs: 300_000, unseen: 'stop' },
      },
      topic: null,
    });
  });

  test('takes its bounds and its topic from the file', () => {
    const { returns } = robotOf([], ros('nav_msgs/msg/Odometry', ', afterS: 60, maxM: 5, topic: /returning'));
    expect(returns?.options).toMatchObject({ afterMs: 60_000, maxM: 5 });
    expect(returns?.topic).toMatchObject({ graph: { kind: 'ros2' }, topic: '/returning' });
  });

  test.each<[string[], RegExp]>([
    [['--obstacle-guard', 'off'], /return.*needs the obstacle guard/],
    [['--return-after-s', '5', '--lease-silence-s', '10'], /return-after-s.*at least 11 s/],
    [['--return-speed', '0.4', '--max-linear', '0.3'], /return-speed.*not be above.*0.3 m\/s/],
    [['--return-topic', '/returning'], /return-topic.*needs a ROS graph/],
    [['--return-topic', 'returning'], /must be a topic’s full name/],
    [['--return-speed', '0.6'], /0.5/],
  ])('%j is refused', (args, why) => {
    expect(() => robotOf(['--return', ...args])).toThrow(why);
  });

  test('needs odometry that says when it was measured, and a sensor whose place is known', () => {
    expect(() => robotOf([], ros('geometry_msgs/msg/PoseStamped'))).toThrow(/needs odometry/);
    expect(() => robotOf(['--return', '--source', 'shm'])).toThrow(/needs the obstacle guard/);
  });
});
