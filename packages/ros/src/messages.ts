/**
 * The supported ROS messages, as far as their fields are used. They come from files or from other nodes, so each is
 * checked.
 */
import type { Quaternion, Vector3 } from '@farpoint/protocol';
import * as z from 'zod';

const finite = z.number();
/** As sensors report it: NaN for unknown values. */
const number = z.union([
  z.number(),
  z.nan(),
  z.literal([Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY]),
]);
const vector3 = z.object({ x: finite, y: finite, z: finite });
const quaternion = z.object({ x: finite, y: finite, z: finite, w: finite });
/** What is none is left to whoever reads it: it must not cost what else the message says. */
const measured = z.object({ x: number, y: number, z: number });
const measuredTurn = z.object({ x: number, y: number, z: number, w: number });
/** The field is `nanosec` in ROS 2 and `nsec` in ROS 1. */
const stamp = z.union([
  z.object({ sec: z.number(), nanosec: z.number() }),
  z.object({ sec: z.number(), nsec: z.number() }),
]);
const frameId = z.string().max(512);
const header = z.object({ stamp, frame_id: frameId });

export const pointFieldSchema = z.object({
  name: z.string().max(128),
  offset: z.int().min(0),
  /** Types that nobody knows do no harm in fields that nobody reads. */
  datatype: z.int().min(0).max(255),
  count: z.int().min(0),
});
export type PointField = z.infer<typeof pointFieldSchema>;

export const pointCloud2Schema = z.object({
  header,
  height: z.int().min(0),
  width: z.int().min(0),
  fields: z.array(pointFieldSchema).max(256),
  is_bigendian: z.boolean(),
  point_step: z.int().min(0),
  row_step: z.int().min(0),
  data: z.instanceof(Uint8Array),
});
export type PointCloud2 = z.infer<typeof pointCloud2Schema>;

/** More than one turn, for scanners that overlap; radians. */
const MOST_SWEEP = 7;
const MOST_RAYS = 16_384;

/** The rays of a planar scanner. What a range means is up to REP 117. */
export const laserScanSchema = z
  .object({
    header,
    angle_min: finite,
    angle_increment: finite.refine((increment) => increment !== 0, 'must not be 0'),
    /** Between two rays, s; 0 if the driver does not say. */
    time_increment: finite,
    range_min: finite.min(0),
    range_max: z.union([finite.positive(), z.literal(Number.POSITIVE_INFINITY)]),
    ranges: z.union([z.instanceof(Float32Array), z.array(number)]),
  })
  .refine(({ ranges }) => ranges.length > 0 && ranges.length <= MOST_RAYS, {
    path: ['ranges'],
    message: `must be 1 to ${MOST_RAYS} rays`,
  })
  .refine(({ ranges, angle_increment }) => Math.abs(ranges.length * angle_increment) <= MOST_SWEEP, {
    path: ['angle_increment'],
    message: 'must make at most one turn of all rays',
  });
export type LaserScan = z.infer<typeof laserScanSchema>;

/** More than any robot has. */
export const MOST_JOINTS = 1024;

/** Joint states come in parts, from several nodes; joints without a position are no news. */
export const jointStateSchema = z.object({
  name: z.array(z.string().max(200)).max(MOST_JOINTS),
  position: z.union([z.instanceof(Float64Array), z.array(number).max(MOST_JOINTS)]),
});

export const stringSchema = z.object({ data: z.string() });

export const tfMessageSchema = z.object({
  transforms: z
    .array(
      z.object({
        header,
        child_frame_id: frameId,
        transform: z.object({ translation: measured, rotation: measuredTurn }),
      }),
    )
    .max(4096),
});

const pose = z.object({ position: vector3, orientation: quaternion });
const measuredPose = z.object({ position: measured, orientation: measuredTurn });

export const odometrySchema = z.object({
  header,
  child_frame_id: frameId,
  pose: z.object({ pose: measuredPose }),
  twist: z.object({ twist: z.object({ linear: measured, angular: measured }) }),
});

/** PoseStamped, or PoseWithCovarianceStamped. */
export const poseStampedSchema = z.object({
  header,
  pose: z.union([measuredPose, z.object({ pose: measuredPose })]),
});

export const imageSchema = z.object({
  header,
  height: z.int().min(0),
  width: z.int().min(0),
  encoding: z.string().max(128),
  is_bigendian: z.union([z.int(), z.boolean()]),
  step: z.int().min(0),
  data: z.instanceof(Uint8Array),
});
export type Image = z.infer<typeof imageSchema>;

export const compressedImageSchema = z.object({
  header,
  format: z.string().max(512),
  data: z.instanceof(Uint8Array),
});
export type CompressedImage = z.infer<typeof compressedImageSchema>;

/** Bytes as represented in JSON. */
const bytes = z.union([
  z.instanceof(Uint8Array),
  z.base64().transform((text) => new Uint8Array(Buffer.from(text, 'base64'))),
]);
const foxgloveImage = z.object({ timestamp: stamp, frame_id: frameId, data: bytes });

/** foxglove.CompressedImage, in any encoding. */
export const foxgloveCompressedImageSchema = foxgloveImage.extend({ format: z.string().max(512) });

/** foxglove.CompressedVideo, in any encoding: one coded picture of a video. */
export const foxgloveCompressedVideoSchema = foxgloveImage.extend({ format: z.string().max(512) });

/** foxglove.RawImage: little-endian. */
export const foxgloveRawImageSchema = foxgloveImage.extend({
  height: z.int().min(0),
  width: z.int().min(0),
  step: z.int().min(0),
  encoding: z.string().max(128),
});

const matrix = (length: number) =>
  z.union([z.array(z.number()), z.instanceof(Float64Array)]).refine((m) => m.length === length);
/** The fields are `K` and `P` in ROS 1, `k` and `p` in ROS 2. */
export const cameraInfoSchema = z
  .object({
    header,
    height: z.int().min(0),
    width: z.int().min(0),
    k: matrix(9).optional(),
    K: matrix(9).optional(),
    p: matrix(12).optional(),
    P: matrix(12).optional(),
  })
  .transform(({ K, P, k, p, ...rest }) => ({ ...rest, k: k ?? K, p: p ?? P }));
export type CameraInfo = z.infer<typeof cameraInfoSchema>;

/** NaN for unknown; JSON, which has no NaN, has null. */
const perhaps = z.union([number, z.null().transform(() => Number.NaN)]);
export const batteryStateSchema = z.object({ voltage: perhaps, percentage: perhaps });

/** For display; a battery in an abnormal state counts as a fault. */
export const batteryDetailsSchema = batteryStateSchema.extend({
  current: perhaps.optional(),
  power_supply_status: z.int().optional(),
  power_supply_health: z.int().optional(),
});

export const navSatFixSchema = z.object({
  header,
  status: z.object({ status: z.int(), service: z.int() }),
  latitude: number,
  longitude: number,
  altitude: number,
  position_covariance: z.union([z.array(number), z.instanceof(Float64Array)]),
  position_covariance_type: z.int(),
});

export const diagnosticArraySchema = z.object({
  header,
  status: z
    .array(z.object({ level: z.union([z.int(), z.string()]), name: z.string(), message: z.string() }))
    .max(4096),
});

/** The poses' own headers say nothing that the path's does not. */
export const pathSchema = z.object({ header, poses: z.array(z.object({ pose })).max(65_536) });

/** More cells than any navigator's map. */
const MOST_CELLS = 4096 * 4096;

/** Probabilities in percent, -1 for unknown, row by row from `origin`. */
export const occupancyGridSchema = z
  .object({
    header,
    info: z.object({
      resolution: finite.min(0.001).max(100),
      width: z.int().min(0),
      height: z.int().min(0),
      origin: pose,
    }),
    data: z.union([z.instanceof(Int8Array), z.array(z.int())]),
  })
  .refine(({ info, data }) => info.width * info.height === data.length && data.length <= MOST_CELLS, {
    path: ['data'],
    message: `must have width × height cells, at most ${MOST_CELLS}`,
  });

/** Types by their role. `foxglove.` names are those of JSON and Protobuf. */
export const POINT_CLOUD_TYPES: readonly string[] = ['sensor_msgs/msg/PointCloud2'];
export const TF_TYPES: readonly string[] = ['tf2_msgs/msg/TFMessage', 'tf/msg/tfMessage'];
export const ODOMETRY_TYPES: readonly string[] = ['nav_msgs/msg/Odometry'];
export const DIAGNOSTIC_TYPES: readonly string[] = ['diagnostic_msgs/msg/DiagnosticArray'];
export const BATTERY_TYPES: readonly string[] = ['sensor_msgs/msg/BatteryState'];
export const FOXGLOVE_COMPRESSED_IMAGE_TYPES = [
  'foxglove_msgs/msg/CompressedImage',
  'foxglove.CompressedImage',
];
export const FOXGLOVE_COMPRESSED_VIDEO_TYPES = [
  'foxglove_msgs/msg/CompressedVideo',
  'foxglove.CompressedVideo',
];
export const FOXGLOVE_RAW_IMAGE_TYPES = ['foxglove_msgs/msg/RawImage', 'foxglove.RawImage'];

/** Nanoseconds since 1970, or since the epoch of the robot's clock. */
export function stampNs(time: z.infer<typeof stamp>): bigint {
  return BigInt(time.sec) * 1_000_000_000n + BigInt('nanosec' in time ? time.nanosec : time.nsec);
}

/** Removes ROS 1's leading slash from a tf name. */
export function frameName(id: string): string {
  return id.startsWith('/') ? id.slice(1) : id;
}

/** @returns `null` if it is no rotation */
export function unitQuaternion({ x, y, z, w }: Quaternion): Quaternion | null {
  const norm = Math.hypot(x, y, z, w);
  if (!(Math.abs(norm - 1) < 0.01)) return null;
  return { x: x / norm, y: y / norm, z: z / norm, w: w / norm };
}

export function isFiniteVector({ x, y, z }: Vector3): boolean {
  return Number.isFinite(x + y + z);
}
