import { messageBytes } from '@farpoint/ros/testing';
import { describe, expect, test } from 'vitest';
import { CollisionCells } from './collision-cells.ts';
import { demandedMps } from './guard-topics-messages.ts';

const INF = Number.POSITIVE_INFINITY;

describe.each([1, 2] as const)('ROS %i', (version) => {
  test('std_msgs/Bool stops, or allows any speed', () => {
    const said = (data: boolean) =>
      demandedMps('bool', version, messageBytes(version, 'std_msgs/msg/Bool', { data }));
    expect([said(true), said(false)]).toEqual([0, INF]);
    expect(demandedMps('bool', version, Uint8Array.of(7))).toBe(0);
  });

  test('std_msgs/Float32 says how fast; what is no speed stops', () => {
    const said = (data: number) =>
      demandedMps('speed', version, messageBytes(version, 'std_msgs/msg/Float32', { data }));
    expect([0.25, 0, INF, -0.5, Number.NaN, -INF].map(said)).toEqual([0.25, 0, INF, 0, 0, 0]);
    const whole = messageBytes(version, 'std_msgs/msg/Float32', { data: 1 });
    expect(demandedMps('speed', version, whole.subarray(0, -1))).toBe(0);
    expect(demandedMps('speed', version, new Uint8Array())).toBe(0);
  });
});

test('big-endian messages are read as such', () => {
  expect(demandedMps('speed', 2, Uint8Array.of(0, 0, 0, 0, 0x3f, 0x00, 0, 0))).toBe(0.5);
});

test('crosses the threads, never as more than was said', () => {
  const here = new CollisionCells();
  const there = new CollisionCells(here.memory);
  expect(here.read(1000)).toBeNull();
  for (const [said, read] of [
    [0.2505, 0.25],
    [0, 0],
    [Number.NaN, 0],
    [-1, 0],
    [INF, INF],
  ] as const) {
    there.setPublishers(1);
    there.hear(said, 990.7);
    expect(here.read(1000)).toEqual({ mostMps: read, atMs: 990, publishers: 1 });
  }
});
