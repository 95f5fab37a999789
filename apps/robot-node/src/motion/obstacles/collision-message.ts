/** What a collision topic's messages mean. */
import { saysStop } from '../stops/bool-message.ts';

/** `bool`: std_msgs/Bool, true stops. `speed`: std_msgs/Float32, the highest speed in m/s. */
export const COLLISION_TYPES = { bool: 'std_msgs/msg/Bool', speed: 'std_msgs/msg/Float32' } as const;
export type CollisionType = keyof typeof COLLISION_TYPES;

/** Bytes of CDR's encapsulation before a ROS 2 message. */
const ENCAPSULATION_BYTES = 4;
const FLOAT_BYTES = 4;

/**
 * The highest speed that a serialised message allows, m/s; infinity for any. What is malformed, no number or negative
 * stops.
 */
export function demandedMps(type: CollisionType, version: 1 | 2, bytes: Uint8Array): number {
  if (type === 'bool') return saysStop(version, bytes) ? 0 : Number.POSITIVE_INFINITY;
  const begin = version === 1 ? 0 : ENCAPSULATION_BYTES;
  if (bytes.length !== begin + FLOAT_BYTES) return 0;
  const isLittle = version === 1 || ((bytes[1] as number) & 1) === 1;
  const most = new DataView(bytes.buffer, bytes.byteOffset, bytes.length).getFloat32(begin, isLittle);
  return Number.isNaN(most) ? 0 : Math.max(0, most);
}
