import type { Twist } from '@farpoint/protocol';
import { describe, expect, it } from 'vitest';
import { RosFault } from './fault.ts';
import { decoderOf } from './message-decoder.ts';
import { velocityWriter } from './velocity.ts';

const twist: Twist = { linear: { x: 0.5, y: 0, z: 0 }, angular: { x: 0, y: 0, z: -1.25 } };
const hex = (bytes: Uint8Array) => Buffer.from(bytes).toString('hex');

describe('velocities', () => {
  it('are Twist in ROS 1 and in CDR', () => {
    // Six little-endian doubles; CDR has a four-byte header that says so.
    const doubles = `000000000000e03f${'00'.repeat(32)}000000000000f4bf`;
    expect(hex(velocityWriter(1, 'geometry_msgs/msg/Twist')(twist, 0n, ''))).toBe(doubles);
    expect(hex(velocityWriter(2, 'geometry_msgs/msg/Twist')(twist, 0n, ''))).toBe(`00010000${doubles}`);
  });

  it.each([1, 2] as const)('are TwistStamped of ROS %i, with stamp, frame and velocity', (version) => {
    const type = 'geometry_msgs/msg/TwistStamped';
    const write = velocityWriter(version, type);
    const message = decoderOf(version, type, null)(write(twist, 1_700_000_000_000_000_009n, 'base_link'));
    expect(message).toMatchObject({
      header: { frame_id: 'base_link', stamp: { sec: 1_700_000_000 } },
      twist,
    });
    const { stamp } = (message as { header: { stamp: { nsec?: number; nanosec?: number } } }).header;
    expect(stamp.nsec ?? stamp.nanosec).toBe(9);
  });

  it('refuse any other type', () => {
    expect(() => velocityWriter(2, 'std_msgs/msg/String')).toThrow(RosFault);
    expect(() => decoderOf(2, 'my_msgs/msg/Own', null)).toThrow(
      'the message type my_msgs/msg/Own is unknown',
    );
  });
});

it('a velocity to the left is in linear.y', () => {
  const aside: Twist = { linear: { x: 0, y: 0.5, z: 0 }, angular: { x: 0, y: 0, z: 0 } };
  // The second of six little-endian doubles.
  const doubles = `${'00'.repeat(8)}000000000000e03f${'00'.repeat(32)}`;
  expect(hex(velocityWriter(1, 'geometry_msgs/msg/Twist')(aside, 0n, ''))).toBe(doubles);
  expect(hex(velocityWriter(2, 'geometry_msgs/msg/Twist')(aside, 0n, ''))).toBe(`00010000${doubles}`);
});
