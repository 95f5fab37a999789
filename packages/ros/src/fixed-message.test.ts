import fc from 'fast-check';
import { describe, expect, it, test } from 'vitest';
import { RosFault } from './fault.ts';
import { fixedMessage } from './fixed-message.ts';
import { decoderOf } from './message-decoder.ts';

describe.each([1, 2] as const)('a fixed message of ROS %i', (version) => {
  test.each<[string, unknown, unknown]>([
    ['std_msgs/msg/Bool', { data: true }, { data: true }],
    ['std_msgs/msg/String', { data: 'dock 1' }, { data: 'dock 1' }],
    ['std_msgs/msg/Empty', {}, {}],
    ['std_msgs/msg/UInt8', { data: 255 }, { data: 255 }],
    ['std_msgs/msg/Int64', { data: -5 }, { data: -5n }],
    ['std_msgs/msg/ColorRGBA', { r: 1, a: 0.5 }, { r: 1, g: 0, b: 0, a: 0.5 }],
    ['geometry_msgs/msg/Vector3', { x: 1.5, z: -2 }, { x: 1.5, y: 0, z: -2 }],
    ['sensor_msgs/msg/Joy', { buttons: [1, 2] }, { buttons: Int32Array.of(1, 2) }],
    [
      'geometry_msgs/msg/PoseStamped',
      { header: { frame_id: 'base_link' }, pose: { position: { x: 2 } } },
      { header: { frame_id: 'base_link' }, pose: { position: { x: 2, y: 0, z: 0 } } },
    ],
  ])('%s has what is given, and zero for the rest', (type, value, read) => {
    expect(decoderOf(version, type, null)(fixedMessage(version, type, value))).toMatchObject(read as object);
  });

  test.each<[string, unknown, RegExp]>([
    ['std_msgs/msg/Bool', { data: 1 }, /^data must be true or false$/],
    ['std_msgs/msg/Bool', { date: true }, /^date is no field of it$/],
    ['std_msgs/msg/Bool', true, /^must be a mapping/],
    ['std_msgs/msg/Bool', [], /^must be a mapping/],
    ['std_msgs/msg/String', { data: 'é' }, /ASCII/],
    ['std_msgs/msg/String', { data: 7 }, /^data must be text/],
    ['std_msgs/msg/UInt8', { data: 256 }, /whole number from 0 to 255/],
    ['std_msgs/msg/UInt8', { data: 0.5 }, /whole number/],
    ['std_msgs/msg/UInt64', { data: -1 }, /whole number that uint64 has/],
    ['std_msgs/msg/Float32', { data: 1e39 }, /too large for float32/],
    ['std_msgs/msg/Float64', { data: Number.POSITIVE_INFINITY }, /must be a number/],
    ['sensor_msgs/msg/Joy', { axes: 1 }, /must be a list/],
    ['sensor_msgs/msg/Joy', { buttons: [1, 0.5] }, /^buttons\.1 must be/],
    ['geometry_msgs/msg/PoseStamped', { header: { stamp: 1 } }, /^header\.stamp/],
    ['geometry_msgs/msg/PoseStamped', { pose: { position: { w: 1 } } }, /^pose\.position\.w is no field/],
    ['my_robot/msg/Arm', {}, /not one of ROS’s own types/],
  ])('%s of %j is refused, with its place', (type, value, message) => {
    expect(() => fixedMessage(version, type, value)).toThrow(message);
    expect(() => fixedMessage(version, type, value)).toThrow(RosFault);
  });

  it('takes anything or refuses it by a RosFault', () => {
    const types = ['std_msgs/msg/Bool', 'std_msgs/msg/Int64', 'geometry_msgs/msg/PoseStamped'];
    const some = fc.oneof(
      fc.jsonValue(),
      fc.record({ data: fc.jsonValue() }),
      fc.record({ pose: fc.jsonValue() }),
    );
    fc.assert(
      fc.property(fc.constantFrom(...types), some, (type, value) => {
        try {
          decoderOf(version, type, null)(fixedMessage(version, type, value));
        } catch (error) {
          expect(error).toBeInstanceOf(RosFault);
        }
      }),
      { seed: 1, numRuns: 300 },
    );
  });
});
