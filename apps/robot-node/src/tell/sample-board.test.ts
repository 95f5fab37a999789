import { decodeJson, encodeJson, telemetryCodec } from '@farpoint/protocol';
import { topicTableSchema } from '@farpoint/ros';
import { describe, expect, it } from 'vitest';
import { describeQuantities, SampleBoard } from './sample-board.ts';

const topics = topicTableSchema.parse([
  { topic: '/battery', as: 'battery' },
  { topic: '/gripper', type: 'std_msgs/Float32', as: 'text', label: 'Gripper', quantities: [{ unit: '°C' }] },
]);
const quantities = describeQuantities(topics);

describe('SampleBoard', () => {
  it('numbers quantities in the order of the table', () => {
    expect(quantities.map(({ number, topic, field, unit }) => [number, topic, field, unit])).toEqual([
      [0, '/battery', 'percentage', '%'],
      [1, '/battery', 'voltage', 'V'],
      [2, '/battery', 'current', 'A'],
      [3, '/gripper', 'data', '°C'],
    ]);
  });

  it('gives all samples to a wide path, and the newest of each quantity to a narrow one', () => {
    const board = new SampleBoard(quantities);
    expect(board.all()).toBeNull();
    board.add('/gripper', [20], 100);
    board.add('/gripper', [21], 120.04);
    board.add('/battery', [50, null, null], 120);
    board.add('/unknown', [1], 120);
    const all = board.all();
    expect(all).toEqual({
      type: 'samples',
      timeMs: 120.04,
      samples: [
        [3, -20, 20],
        [3, 0, 21],
        [0, 0, 50],
      ],
    });
    expect(decodeJson(telemetryCodec, encodeJson(telemetryCodec, all!))).toEqual(all);
    expect(board.all()).toBeNull();
    board.add('/gripper', [22], 140);
    expect(board.newest()?.samples).toEqual([
      [3, 0, 22],
      [0, -20, 50],
    ]);
    expect(board.newest()).toBeNull();
    expect(board.all()?.samples).toEqual([[3, 0, 22]]);
  });

  it('is bounded: the oldest samples are dropped and counted, and a full message fits its channel', () => {
    const board = new SampleBoard(quantities);
    for (let i = 0; i < 1000; i++) board.add('/gripper', [-Number.MIN_VALUE / (i + 1)], 1e9 + i / 3);
    expect(board.dropped).toBe(936);
    expect(board.all()?.samples).toHaveLength(64);
    for (let i = 0; i < 64; i++) board.add('/gripper', [-Math.PI * 1e-300], 1e9 + i * 1000.3);
    expect(() => encodeJson(telemetryCodec, board.all()!)).not.toThrow();
  });
});
