/**
 * Where a packet's points stand: the trailer that our own profile appends to each payload, so that a packet that
 * arrives alone can be drawn in its place. 28 bytes, little-endian, at the very end:
 *
 *     0  f32 ×3  position of the camera's optical frame in the world, metres
 *    12  i16 ×4  orientation x, y, z, w × 32767, saturating
 *    20  u32     capture time, microseconds of the robot's monotonic clock, wraps every 71.6 minutes
 *    24  u8      flags: bit 0 latency-test frame, bit 1 some coordinate of the frame was saturated
 *    25  u8      sensor index
 *    26  u8      reserved, 0
 *    27  u8      format of the point data: 1 points64, 2 organised, 3 unorganised (cloud-format.ts)
 */
import { type CloudFormat, cloudFormatNumber, cloudFormatOf } from './cloud-format.ts';
import type { Pose } from './geometry.ts';

/** The layout above, bytes. */
export const PLACEMENT_BYTES = 28;
/** No robot announces more cloud sensors than this. */
export const MAX_SENSORS = 8;
export const FLAG_LATENCY_TEST = 1;
export const FLAG_SATURATED = 2;

/** The largest i16: a quaternion's component of 1. */
const QUATERNION_SCALE = 32767;

export interface Placement {
  pose: Pose;
  captureTimeUs: number;
  latencyTest: boolean;
  saturated: boolean;
  sensor: number;
  format: CloudFormat;
}

/** Why a trailer is refused. */
export type PlacementFault =
  | 'too-short'
  | 'unknown-format' // the last byte names a format that this peer does not know
  | 'bad-pose'; // a position that is not finite, or a quaternion far from unit length

export function emptyPlacement(): Placement {
  return {
    pose: { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } },
    captureTimeUs: 0,
    latencyTest: false,
    saturated: false,
    sensor: 0,
    format: 'points64',
  };
}

/** Copies every value; `into` keeps its own objects, and nothing is allocated. */
export function copyPlacement(from: Placement, into: Placement): void {
  Object.assign(into.pose.position, from.pose.position);
  Object.assign(into.pose.orientation, from.pose.orientation);
  into.captureTimeUs = from.captureTimeUs;
  into.latencyTest = from.latencyTest;
  into.saturated = from.saturated;
  into.sensor = from.sensor;
  into.format = from.format;
}

/** Writes the 28 bytes at `offset`, where the view must have room. */
export function writePlacement(view: DataView, offset: number, placement: Placement): void {
  const { position, orientation } = placement.pose;
  view.setFloat32(offset, position.x, true);
  view.setFloat32(offset + 4, position.y, true);
  view.setFloat32(offset + 8, position.z, true);
  view.setInt16(offset + 12, toInt16(orientation.x), true);
  view.setInt16(offset + 14, toInt16(orientation.y), true);
  view.setInt16(offset + 16, toInt16(orientation.z), true);
  view.setInt16(offset + 18, toInt16(orientation.w), true);
  view.setUint32(offset + 20, placement.captureTimeUs >>> 0, true);
  view.setUint8(
    offset + 24,
    (placement.latencyTest ? FLAG_LATENCY_TEST : 0) | (placement.saturated ? FLAG_SATURATED : 0),
  );
  view.setUint8(offset + 25, placement.sensor);
  view.setUint8(offset + 26, 0);
  view.setUint8(offset + 27, cloudFormatNumber(placement.format));
}

/**
 * A pose may deviate slightly from unit length. Saturates, because a component above 1 would otherwise wrap to the
 * opposite sign.
 */
function toInt16(component: number): number {
  const scaled = Math.round(component * QUATERNION_SCALE);
  return Math.min(Math.max(scaled, -QUATERNION_SCALE), QUATERNION_SCALE);
}

/** Reads the trailer at the end of `view` into `into`, without allocating. Returns what is wrong, or `null`. */
export function readPlacement(view: DataView, into: Placement): PlacementFault | null {
  if (view.byteLength < PLACEMENT_BYTES) return 'too-short';
  const offset = view.byteLength - PLACEMENT_BYTES;
  const format = cloudFormatOf(view.getUint8(offset + 27));
  if (format === undefined) return 'unknown-format';
  const { position, orientation } = into.pose;
  position.x = view.getFloat32(offset, true);
  position.y = view.getFloat32(offset + 4, true);
  position.z = view.getFloat32(offset + 8, true);
  if (!Number.isFinite(position.x + position.y + position.z)) return 'bad-pose';
  orientation.x = view.getInt16(offset + 12, true) / QUATERNION_SCALE;
  orientation.y = view.getInt16(offset + 14, true) / QUATERNION_SCALE;
  orientation.z = view.getInt16(offset + 16, true) / QUATERNION_SCALE;
  orientation.w = view.getInt16(offset + 18, true) / QUATERNION_SCALE;
  const norm = Math.hypot(orientation.x, orientation.y, orientation.z, orientation.w);
  if (Math.abs(norm - 1) > 0.01) return 'bad-pose';
  into.captureTimeUs = view.getUint32(offset + 20, true);
  const flags = view.getUint8(offset + 24);
  into.latencyTest = (flags & FLAG_LATENCY_TEST) !== 0;
  into.saturated = (flags & FLAG_SATURATED) !== 0;
  into.sensor = view.getUint8(offset + 25);
  into.format = format;
  return null;
}
