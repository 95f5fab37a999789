import { isAvailable } from '@farpoint/dds';
import { findPeer, PEER_REMEDY, Peer, testDomain } from '@farpoint/dds/testing';
import { topicTableSchema } from '@farpoint/ros';
import { Ros1Peers } from '@farpoint/ros/testing/ros1';
import { afterAll, describe, expect, it } from 'vitest';
import { checkRos } from './ros-probe.ts';

const table = topicTableSchema.parse([
  { topic: '/camera/points', as: 'cloud' },
  { topic: '/odom', as: 'pose' },
  { topic: '/cmd_vel', as: 'velocity' },
]);

it('a missing master is a failure with a remedy', async () => {
  const results = await checkRos(
    { kind: 'ros1', name: 'r', hostname: 'localhost', masterUrl: 'http://127.0.0.1:1' },
    table,
    0,
    1000,
  );
  expect(results).toMatchObject([{ verdict: 'fail', remedy: expect.stringContaining('roscore') as string }]);
});

const { python, missing } = Ros1Peers.find();
describe.skipIf(python === null)(`a real master (${missing ?? 'found'})`, () => {
  let peers: Ros1Peers | null = null;
  afterAll(() => peers?.close());

  it('answers, and none of the topics exist', async () => {
    peers = await Ros1Peers.open(python as string);
    await peers.startCore();
    const options = {
      kind: 'ros1',
      name: 'doctor_test',
      hostname: 'localhost',
      masterUrl: peers.masterUrl,
    } as const;
    const results = await checkRos(options, table, 0, 10_000);
    expect(results.map(({ verdict }) => verdict).join(' ')).toBe('ok fail warn warn');
    await peers.startNode('cloud,state', 'camera');
    const points = topicTableSchema.parse([
      { topic: '/points', as: 'cloud' },
      { topic: '/odom', as: 'pose' },
    ]);
    expect((await checkRos(options, points, 0, 10_000)).map(({ verdict }) => verdict).join(' ')).toBe(
      'ok ok ok',
    );
  }, 60_000);
});

const peerCommand = isAvailable() ? findPeer('Python') : null;
it.skipIf(peerCommand === null)(
  `a ROS 2 graph with a camera of another implementation (needs pnpm build:native dds and ${PEER_REMEDY.Python})`,
  async () => {
    const peer = await Peer.start(peerCommand ?? [], {
      ...{ domain: testDomain(), cloud: 'rt/points', side: 16, hz: 20, twist: 'rt/cmd_vel' },
    });
    try {
      const topics = topicTableSchema.parse([
        { topic: '/points', as: 'cloud' },
        { topic: '/cmd_vel', as: 'velocity' },
        { topic: '/nowhere', as: 'pose' },
      ]);
      const results = await checkRos(
        { kind: 'ros2', domain: testDomain(), localhostOnly: true },
        topics,
        0,
        1000,
      );
      expect(results.map(({ verdict }) => verdict).join(' ')).toBe('ok ok ok warn');
    } finally {
      await peer.kill();
    }
  },
  60_000,
);
