import { messageBytes } from '@farpoint/ros/testing';
import { expect, test } from 'vitest';
import { boolMessage, saysStop } from './bool-message.ts';

test.each([1, 2] as const)('ROS %i: what std_msgs/Bool says', (version) => {
  for (const data of [false, true])
    expect(saysStop(version, messageBytes(version, 'std_msgs/msg/Bool', { data }))).toBe(data);
});

test('anything else stops', () => {
  const odd: [1 | 2, number[]][] = [
    [1, []],
    [1, [0, 0]],
    [1, [7]],
    [2, []],
    [2, [0, 1, 0, 0]],
    [2, [0, 1, 0, 0, 2]],
    [2, [0, 1, 0, 0, 0, 0, 0, 0, 0]],
  ];
  for (const [version, bytes] of odd) expect(saysStop(version, Uint8Array.from(bytes))).toBe(true);
  expect(saysStop(2, Uint8Array.of(0, 1, 0, 3, 0, 0, 0, 0))).toBe(false);
});

test.each([1, 2] as const)('of ROS %i is what other nodes write', (version) => {
  for (const data of [true, false]) {
    const theirs = [...messageBytes(version, 'std_msgs/msg/Bool', { data })];
    expect(theirs.slice(0, 5)).toEqual([...boolMessage(version, data)]);
    expect(saysStop(version, boolMessage(version, data))).toBe(data);
  }
});
