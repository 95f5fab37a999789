import { arch, platform } from 'node:os';
import { expect, it } from 'vitest';
import { LATCHED_QOS, SENSOR_QOS, VELOCITY_QOS } from '../graph.ts';
import { binaryPaths } from './native-binary.ts';
import { qosValues, rclnodejsSchema } from './rclnodejs-api.ts';
import { othersOf } from './topics.ts';

it.each([
  ['sensors', SENSOR_QOS, [1, 5, 2, 2]],
  ['velocities', VELOCITY_QOS, [1, 1, 1, 2]],
  ['what is latched', LATCHED_QOS, [1, 100, 1, 1]],
] as const)('QoS of %s in rmw’s numbers: keep last, depth, reliability, durability', (_, qos, values) => {
  expect(qosValues(qos)).toEqual(values);
});

it('rejects a module that is not rclnodejs', () => {
  const nothing = () => undefined;
  const api = { init: nothing, shutdown: nothing, Node: nothing, NodeOptions: nothing, QoS: nothing };
  const Context = Object.assign(() => undefined, { defaultContext: nothing });
  expect(rclnodejsSchema.safeParse({ ...api, Context, more: 1 }).success).toBe(true);
  expect(rclnodejsSchema.safeParse({ ...api, Context: nothing }).success).toBe(false);
  expect(rclnodejsSchema.safeParse({ ...api, Context, init: 1 }).success).toBe(false);
});

it('a binary is one for this ROS and this system, or one built here', () => {
  const osRelease = 'ID=ubuntu\nVERSION_CODENAME=noble\nUBUNTU_CODENAME=noble\n';
  expect(binaryPaths('/m', { ROS_DISTRO: 'jazzy' }, osRelease)).toEqual([
    `/m/prebuilds/${platform()}-${arch()}/jazzy-noble-${arch()}-node-rclnodejs.node`,
    '/m/build/Release/rclnodejs.node',
  ]);
});

it('counts others on a topic by type, without ourselves', () => {
  const node = (node_name: string, topic_type: string) => ({ node_name, node_namespace: '/', topic_type });
  const publishers = [node('a', 'T'), node('a', 'U'), node('robot', 'T'), node('b', 'T')];
  expect(othersOf('/x', 'robot', publishers, [node('robot', 'T'), node('c', 'V')])).toEqual([
    { topic: '/x', type: 'T', publishers: 2, subscribers: 0 },
    { topic: '/x', type: 'U', publishers: 1, subscribers: 0 },
    { topic: '/x', type: 'V', publishers: 0, subscribers: 1 },
  ]);
});
