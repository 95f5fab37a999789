import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { topicTableSchema } from '@farpoint/ros';
import { MemoryGraph } from '@farpoint/ros/testing';
import { OptionsError } from '@farpoint/service';
import { useFolder } from '@farpoint/service/testing/folder';
import { beforeAll, expect, it } from 'vitest';
import { robotOf } from '../../program/options/testing/robot-of.ts';
import { describeTopics, readFrom, sourcedFolders } from './message-folders.ts';
import { listen } from './ros-listener.ts';

const folder = useFolder();
const TABLE = [
  { topic: '/points', as: 'cloud' },
  { topic: '/grip', as: 'text', type: 'arm_msgs/msg/Grip' },
];

beforeAll(() => {
  mkdirSync(join(folder, 'arm_msgs', 'msg'), { recursive: true });
  writeFileSync(join(folder, 'arm_msgs', 'msg', 'Grip.msg'), 'float32 force\nFinger[2] fingers\n');
  writeFileSync(join(folder, 'arm_msgs', 'msg', 'Finger.msg'), 'bool touches\n');
});

it('reads messages whose type is defined only in files', () => {
  const topics = describeTopics(topicTableSchema.parse(TABLE), readFrom(['/nowhere', folder]));
  expect(topics[0]).not.toHaveProperty('definitions');
  const [, grip] = topics;
  if (grip === undefined) throw new Error('two topics');
  const graph = new MemoryGraph(2, () => 0);
  const messages: unknown[] = [];
  // In the form in which it is sent to the capture thread.
  const entry = structuredClone(grip);
  listen(
    graph,
    entry,
    { queue: 1, limited: false, onFault: (fault) => messages.push(fault.message) },
    (message) => messages.push(structuredClone(message)),
  );
  const bytes = Uint8Array.of(0, 1, 0, 0, 0, 0, 0x48, 0x41, 1, 0);
  graph.sayBytes('/grip', bytes);
  graph.sayBytes('/grip', bytes.subarray(0, 9));
  expect(messages[0]).toEqual({ force: 12.5, fingers: [{ touches: true }, { touches: false }] });
  expect(messages[1]).toMatch(/^\/grip: byte \d+: /);
});

it('says at the start which file is missing, and where to configure its folder', () => {
  const options = (text: string) => robotOf([], text);
  const file = (messages: string) =>
    `robot:\n  source: {kind: ros2}\n  ros: {messages: ${JSON.stringify(messages)}}\n  topics: ${JSON.stringify(TABLE)}\n`;
  expect(() => options(file('/nowhere'))).toThrow(OptionsError);
  expect(() => options(file('/nowhere'))).toThrow(
    /robot\.topics \/grip: arm_msgs\/msg\/Grip\.msg was not found \(searched: the folders of ros\.messages/,
  );
  expect(options(file(folder)).sensors[0]?.capture.source).toMatchObject({
    topics: [{}, { definitions: [{ name: 'arm_msgs/Grip' }, { name: 'arm_msgs/Finger' }] }],
  });
});

it('finds the folders of a sourced ROS', () => {
  expect(sourcedFolders({ AMENT_PREFIX_PATH: '/ws/install/a:/opt/ros/jazzy' })).toEqual([
    '/ws/install/a/share',
    '/opt/ros/jazzy/share',
  ]);
  expect(sourcedFolders({})).toEqual([]);
});
