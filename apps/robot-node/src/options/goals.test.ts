import { resolveOptions } from '@farpoint/service';
import { describe, expect, test } from 'vitest';
import { toRobotOptions } from './robot-options.ts';
import { robotProgram } from './robot-program.ts';

function robot(argv: string[], text: string | null = null) {
  const resolved = resolveOptions(robotProgram, { argv, env: {}, readFile: () => text });
  if (resolved.action !== 'run') throw new Error('printed');
  return toRobotOptions(resolved.values, resolved.where);
}

const ros = (goals: string, pose = 'nav_msgs/msg/Odometry') => `robot:
  source: { kind: ros2 }
  sink: { kind: ros2 }
  topics:
    - { topic: /points, as: cloud }
    - { topic: /odom, as: pose, type: ${pose} }
    - { topic: /cmd_vel, as: velocity }
  goals: { ${goals} }`;

describe('a robot that takes goals', () => {
  test('does so only if it is told to', () => {
    expect(robot([]).goals).toBeUndefined();
    expect(robot(['--goals', 'sim', '--goals-max-m', '5']).goals).toEqual({
      ...{ mostM: 5, navigatorSilentMs: 300, navigator: { kind: 'sim' } },
    });
  });

  test('has a navigator in its ROS graph', () => {
    const { goals } = robot([], ros('navigator: ros, frame: map, velocityType: TwistStamped'));
    expect(goals?.navigator).toMatchObject({
      ...{ kind: 'ros', graph: { kind: 'ros2' }, goalTopic: '/goal_pose', frame: 'map' },
      ...{ velocityTopic: '/cmd_vel_nav', velocityType: 'geometry_msgs/msg/TwistStamped' },
    });
  });

  test.each<[string[], string | null, RegExp]>([
    [['--goals', 'ros'], null, /needs a ROS graph/],
    [[], ros('navigator: sim'), /only with the source sim/],
    [[], ros('navigator: ros', 'geometry_msgs/msg/PoseStamped'), /needs odometry/],
    [[], ros('navigator: ros, velocityTopic: /cmd_vel'), /must not be the topic on which/],
    [['--goals', 'sim', '--goals-topic', 'goal'], null, /full name/],
  ])('%j: is refused', (argv, text, message) => {
    expect(() => robot(argv, text)).toThrow(message);
  });
});
