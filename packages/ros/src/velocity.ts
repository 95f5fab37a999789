/** Velocities in the messages that bases, twist_mux and Nav2 accept: geometry_msgs Twist and TwistStamped. */
import { nextSequence32, type Twist } from '@farpoint/protocol';
import { MessageWriter as Ros1Writer } from '@foxglove/rosmsg-serialization';
import { MessageWriter as Ros2Writer } from '@foxglove/rosmsg2-serialization';
import * as z from 'zod';
import { definitionsOf } from './definitions.ts';
import { RosFault } from './fault.ts';
import { decoderOf } from './message-decoder.ts';

export type VelocityWriter = (twist: Twist, stampNs: bigint, frameId: string) => Uint8Array;

/**
 * @param type `geometry_msgs/msg/Twist` or `geometry_msgs/msg/TwistStamped`
 * @throws {RosFault} `unsupported` for any other
 */
export function velocityWriter(version: 1 | 2, type: string): VelocityWriter {
  const stamped = type === 'geometry_msgs/msg/TwistStamped';
  const definitions = definitionsOf(version, type);
  if (definitions === null || !(stamped || type === 'geometry_msgs/msg/Twist')) {
    throw new RosFault('unsupported', `velocities as ${type}`);
  }
  const writer = version === 1 ? new Ros1Writer(definitions) : new Ros2Writer(definitions);
  if (!stamped) return (twist) => writer.writeMessage(twist);
  let seq = 0;
  return (twist, stampNs, frame_id) => {
    const sec = Number(stampNs / 1_000_000_000n);
    const nsec = Number(stampNs % 1_000_000_000n);
    // Each writer uses the field names of its own version.
    const stamp = { sec, nsec, nanosec: nsec };
    seq = nextSequence32(seq);
    return writer.writeMessage({ header: { seq, stamp, frame_id }, twist });
  };
}

const vectorSchema = z.object({ x: z.number(), y: z.number(), z: z.number() });
const twistSchema = z.object({ linear: vectorSchema, angular: vectorSchema });
const stampedSchema = z.object({ twist: twistSchema });

/**
 * Reads another node's velocities.
 *
 * @param type as for {@link velocityWriter}
 * @returns a function that returns `null` for what is no such message, and for numbers that are not finite
 * @throws {RosFault} `unsupported` for any other type
 */
export function velocityReader(version: 1 | 2, type: string): (bytes: Uint8Array) => Twist | null {
  const stamped = type === 'geometry_msgs/msg/TwistStamped';
  if (!(stamped || type === 'geometry_msgs/msg/Twist')) {
    throw new RosFault('unsupported', `velocities as ${type}`);
  }
  const decode = decoderOf(version, type, null);
  return (bytes) => {
    try {
      const message = decode(bytes);
      return stamped ? stampedSchema.parse(message).twist : twistSchema.parse(message);
    } catch {
      // Whatever is wrong with it: it says nothing that a robot may follow.
      return null;
    }
  };
}
