/** One truth about where a sensor sits: each source, each mount, at a wall whose place is known exactly. */
import { shareInEachRun, someOf } from '@farpoint/network-sim/cases';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { describe, expect, it } from 'vitest';
import type { SensorMount } from '../../sense/sources/sensor-mount.ts';
import {
  cloudAt,
  mountTransform,
  ODOMETRY,
  odometryAt,
  POSE,
  poseAt,
  type RosWall,
  rosWall,
  TF,
  transformAt,
} from '../../testing/ros-wall-source.ts';
import { driveAtWall, type WallTruth } from '../../testing/wall-drive.ts';

const level: SensorMount = { x: 0, y: 0, z: 0.9, roll: 0, pitch: 0, yaw: 0 };
const MOUNTS: [string, SensorMount][] = [
  ['level', level],
  ['pitched by 0.35', { ...level, x: 0.1, pitch: 0.35 }],
  ['pitched by 0.7', { ...level, x: 0.2, z: 1.1, pitch: 0.7 }],
  ['tilted back', { ...level, pitch: -0.5 }],
  ['offset', { ...level, x: -0.5, y: 0.45, z: 0.5 }],
  ['yawed and rolled', { ...level, x: 0.3, y: -0.2, yaw: 1.1, roll: 0.3 }],
  ['rear', { ...level, x: -0.4, pitch: 0.4, yaw: Math.PI }],
];
const CLOUD_TOPIC = { topic: '/points', as: 'cloud' };
const CLOUD = 'sensor_msgs/msg/PointCloud2';

/** What says where the robot is, and its sensor. */
const GRAPHS: [string, unknown[], (wall: RosWall, truth: WallTruth, mount: SensorMount) => void][] = [
  [
    'odometry, the mount configured only',
    [{ topic: '/odom', as: 'pose' }],
    ({ graph }, truth) => graph.say('/odom', ODOMETRY, odometryAt(truth.nowMs, truth.x, truth)),
  ],
  [
    'odometry, and the mount in tf, too',
    [
      { topic: '/odom', as: 'pose' },
      { topic: '/tf_static', as: 'tf' },
    ],
    ({ graph }, truth, mount) => {
      graph.say('/tf_static', TF, { transforms: [mountTransform(mount)] });
      graph.say('/odom', ODOMETRY, odometryAt(truth.nowMs, truth.x, truth));
    },
  ],
  [
    'odometry, and a mount in tf that is not connected with it',
    [
      { topic: '/odom', as: 'pose' },
      { topic: '/tf_static', as: 'tf' },
    ],
    ({ graph }, truth, mount) => {
      graph.say('/tf_static', TF, { transforms: [mountTransform(mount)] });
      graph.say('/odom', ODOMETRY, odometryAt(truth.nowMs, truth.x, truth, 'body'));
    },
  ],
  [
    'tf alone',
    [
      { topic: '/tf', as: 'tf' },
      { topic: '/tf_static', as: 'tf' },
    ],
    ({ graph }, { nowMs, base }, mount) => {
      graph.say('/tf_static', TF, { transforms: [mountTransform(mount)] });
      graph.say('/tf', TF, { transforms: [transformAt(nowMs, 'odom', 'base_link', base)] });
    },
  ],
  [
    'poses without a velocity',
    [{ topic: '/pose', as: 'pose', type: POSE }],
    ({ graph }, { nowMs, x }) => graph.say('/pose', POSE, poseAt(nowMs, x)),
  ],
];

describe.each(GRAPHS)('ROS with %s', async (name, topics, say) => {
  const codec = await loadCodecFromDisk();

  // Each mount with another source, until all are tried with all.
  const from = GRAPHS.findIndex(([each]) => each === name);

  it.each(someOf(MOUNTS, from, shareInEachRun(1 / 7)))(
    'a sensor that is %s stops the robot before the wall',
    async (_, mount) => {
      // Forwards, or backwards with the one that looks back.
      const speed = Math.abs(mount.yaw) > 2 ? -0.6 : 0.6;
      const wall = await rosWall([CLOUD_TOPIC, ...topics], mount);
      const { source, graph, setNow } = wall;
      const { gapM, contactMps, fastestMps } = driveAtWall(codec, {
        ...{ mount, source, setNow, speed, odometry: true },
        feed: (truth) => {
          say(wall, truth, mount);
          graph.say('/points', CLOUD, cloudAt(truth.nowMs, truth.points));
        },
      });
      source.close();
      expect([contactMps, wall.faults]).toEqual([null, []]);
      expect(gapM).toBeGreaterThan(0.03);
      expect(gapM).toBeLessThan(0.35);
      expect(fastestMps).toBeGreaterThan(0.5);
    },
  );
});

describe('a mount that tf contradicts', async () => {
  const codec = await loadCodecFromDisk();
  const drive = async (inTf: SensorMount) => {
    const [, topics, say] = GRAPHS[1] as (typeof GRAPHS)[number];
    const wall = await rosWall([CLOUD_TOPIC, ...topics], level);
    const { source, graph, setNow, faults } = wall;
    const driven = driveAtWall(codec, {
      ...{ mount: level, source, setNow, odometry: true },
      feed: (truth) => {
        say(wall, truth, inTf);
        graph.say('/points', CLOUD, cloudAt(truth.nowMs, truth.points));
      },
    });
    source.close();
    return { ...driven, faults };
  };

  it.each([
    ['by 3 cm', { ...level, y: 0.03 }],
    ['by 2°', { ...level, pitch: 0.035 }],
    ['by a quarter turn', { ...level, yaw: Math.PI / 2 }],
  ])('%s is a fault, and the robot stands', async (_, inTf) => {
    const { fastestMps, faults } = await drive(inTf);
    expect(fastestMps).toBe(0);
    expect(faults[0]).toMatch(
      /^\/points: guard\.mount and tf disagree about where lidar sits: by \d+ cm and \d+°; /,
    );
  });

  it.each([
    ['1 cm', { ...level, z: 0.91 }],
    ['0.5°', { ...level, roll: 0.008 }],
  ])('by %s is none', async (_, inTf) => {
    const { contactMps, faults, fastestMps } = await drive(inTf);
    expect([contactMps, faults]).toEqual([null, []]);
    expect(fastestMps).toBeGreaterThan(0.5);
  });
});
