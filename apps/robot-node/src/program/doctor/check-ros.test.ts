import { topicTableSchema } from '@farpoint/ros';
import { describe, expect, it } from 'vitest';
import type { RobotOptions } from '../robot-configuration.ts';
import { judgeHostname, judgeTopics } from './check-ros.ts';
import { graphsOf } from './ros-probe.ts';

const table = topicTableSchema.parse([
  { topic: '/camera/points', as: 'cloud' },
  { topic: '/odom', as: 'pose' },
  { topic: '/cmd_vel', as: 'velocity' },
]);
const seen = (topic: string, type: string, publishers: number, subscribers = 0) => ({
  topic,
  type,
  publishers,
  subscribers,
});
const cloud = 'sensor_msgs/msg/PointCloud2';
const twist = 'geometry_msgs/msg/Twist';
const odometry = seen('/odom', 'nav_msgs/msg/Odometry', 1);

describe('topics', () => {
  it('warns of pictures that are missing or have another type', () => {
    const pictures = topicTableSchema.parse([
      { topic: '/front/image_raw', as: 'picture' },
      { topic: '/rear', as: 'picture' },
      { topic: '/left/image_raw/compressed', as: 'picture' },
    ]);
    const graph = [
      seen('/front/image_raw', 'sensor_msgs/msg/Image', 1),
      seen('/rear', 'sensor_msgs/msg/CompressedImage', 1),
    ];
    expect(judgeTopics(pictures, graph, 0)).toMatchObject([
      { verdict: 'ok' },
      {
        verdict: 'warn',
        detail: '/rear (picture) is of type sensor_msgs/msg/CompressedImage, not sensor_msgs/msg/Image',
      },
      { verdict: 'warn' },
    ]);
  });

  it.each([
    ['all there', [seen('/camera/points', cloud, 1), odometry, seen('/cmd_vel', twist, 0, 1)], 'ok ok ok'],
    ['nothing', [], 'fail warn warn'],
    [
      'the cloud of another type',
      [seen('/camera/points', 'sensor_msgs/msg/LaserScan', 1), odometry],
      'fail ok warn',
    ],
    [
      'others that drive',
      [seen('/camera/points', cloud, 2), odometry, seen('/cmd_vel', twist, 2, 1)],
      'ok ok warn',
    ],
    [
      'a base that reads another type',
      [seen('/cmd_vel', 'geometry_msgs/msg/TwistStamped', 0, 1)],
      'fail warn fail',
    ],
  ])('%s', (_, graph, verdicts) => {
    expect(
      judgeTopics(table, graph, 0)
        .map(({ verdict }) => verdict)
        .join(' '),
    ).toBe(verdicts);
  });

  it('does not count the robot’s own publisher as another', () => {
    expect(judgeTopics(table, [seen('/cmd_vel', twist, 1, 1)], 1)[2]?.verdict).toBe('ok');
  });

  it('suggests a topic with the same last name', () => {
    expect(judgeTopics(table, [seen('/zed/camera/points', cloud, 1)], 0)[0]?.remedy).toContain(
      '(there is /zed/camera/points)',
    );
  });

  it('warns of an address that only this machine can resolve', () => {
    const ros1 = {
      kind: 'ros1',
      name: 'r',
      hostname: 'localhost',
      masterUrl: 'http://10.0.0.2:11311',
    } as const;
    expect(judgeHostname(ros1)[0]?.verdict).toBe('fail');
    expect(judgeHostname({ ...ros1, masterUrl: 'http://localhost:11311' })).toEqual([]);
    expect(judgeHostname({ ...ros1, hostname: '10.0.0.3' })).toEqual([]);
    expect(judgeHostname({ kind: 'ros2' })).toEqual([]);
  });
});

it('of a robot’s video cameras, each graph has the topics that are used there', () => {
  const [ros1, ros2] = [
    { kind: 'ros1', name: 'r', masterUrl: 'http://localhost:11311', hostname: 'localhost' },
    { kind: 'ros2', name: 'r' },
  ] as const;
  const image = (topic: string) =>
    ({ topic, type: 'sensor_msgs/msg/Image', as: 'picture', most: null }) as const;
  const camera = (graph: typeof ros1 | typeof ros2, topic: string) => ({
    source: { kind: 'ros', graph, entry: image(topic) },
  });
  const robot = {
    sensors: [{ capture: { source: { kind: 'ros', graph: ros1 } } }],
    sink: { kind: 'base' },
    videos: [
      camera(ros1, '/front'),
      camera(ros2, '/rear'),
      camera(ros1, '/front'),
      { source: { kind: 'sim' } },
    ],
    stops: { topic: { graph: ros2, topic: '/stop', silentMs: 500 }, key: false },
  } as unknown as RobotOptions;
  const used = graphsOf(robot, [image('/table')]);
  expect(used.map(({ graph, table: topics }) => [graph.kind, topics.map(({ topic }) => topic)])).toEqual([
    ['ros1', ['/table', '/front']],
    ['ros2', ['/rear', '/stop']],
  ]);
  // Without it the robot stands.
  const ros2Table = used[1]?.table ?? [];
  expect(judgeTopics(ros2Table, [], 0).map(({ verdict }) => verdict)).toEqual(['warn', 'fail']);
});
