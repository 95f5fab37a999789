/** ROS 2 messages in CDR, as our recordings contain them. */
import type { Pose, Twist } from '@farpoint/protocol';
import { FLOAT32, velocityWriter } from '@farpoint/ros';
import { parse } from '@foxglove/rosmsg';
import { MessageWriter } from '@foxglove/rosmsg2-serialization';
import { RECORDED_POINT_BYTES } from './captured-cloud.ts';
import type { VideoFormatName } from './recorder-messages.ts';
import {
  FOXGLOVE_COMPRESSED_IMAGE_SCHEMA,
  FOXGLOVE_COMPRESSED_VIDEO_SCHEMA,
  FOXGLOVE_LOG_SCHEMA,
  ODOMETRY_SCHEMA,
  POINT_CLOUD2_SCHEMA,
  TF_MESSAGE_SCHEMA,
} from './ros-schemas.ts';

export const WORLD_FRAME = 'world';
export const BASE_FRAME = 'base_link';
export const CAMERA_FRAME = 'camera_optical_frame';

export const writerOf = (schema: string) => new MessageWriter(parse(schema, { ros2: true }));
const clouds = writerOf(POINT_CLOUD2_SCHEMA);
const transforms = writerOf(TF_MESSAGE_SCHEMA);
const velocities = velocityWriter(2, 'geometry_msgs/msg/TwistStamped');
const odometry = writerOf(ODOMETRY_SCHEMA);
const pictures = writerOf(FOXGLOVE_COMPRESSED_IMAGE_SCHEMA);
const videos = writerOf(FOXGLOVE_COMPRESSED_VIDEO_SCHEMA);
const logLines = writerOf(FOXGLOVE_LOG_SCHEMA);

/** Of foxglove.Log. */
const INFO = 2;

const FIELDS = ['x', 'y', 'z', 'rgb'].map((name, i) => ({
  name,
  offset: i * 4,
  datatype: FLOAT32,
  count: 1,
}));
const NO_COVARIANCE = new Float64Array(36);
/** What follows a cloud's points: `is_dense`. */
const TAIL = Uint8Array.of(0);

function timeOf(ns: bigint) {
  return { sec: Number(ns / 1_000_000_000n), nanosec: Number(ns % 1_000_000_000n) };
}

export function headerOf(stampNs: bigint, frame_id: string) {
  return { stamp: timeOf(stampNs), frame_id };
}

/**
 * The library takes a string's length for the number of its bytes, and writes no more of it. With one more character for
 * each further byte, which it then leaves out, it writes the whole string.
 */
export function cdrText(text: string): string {
  return text + '\0'.repeat(Buffer.byteLength(text) - text.length);
}

/** In parts, so that the points are not copied. @param points 16 bytes each, x, y, z, rgb */
export function pointCloud2(
  stampNs: bigint,
  width: number,
  height: number,
  points: Uint8Array,
): Uint8Array[] {
  const head = clouds.writeMessage({
    header: headerOf(stampNs, CAMERA_FRAME),
    height,
    width,
    fields: FIELDS,
    is_bigendian: false,
    point_step: RECORDED_POINT_BYTES,
    row_step: RECORDED_POINT_BYTES * width,
    data: new Uint8Array(0),
    is_dense: false,
  });
  // An empty cloud ends with the length of its points, 0, and one more byte; the length is corrected here.
  const lengthAt = head.length - TAIL.length - 4;
  new DataView(head.buffer, head.byteOffset).setUint32(lengthAt, points.length, true);
  return [head.subarray(0, lengthAt + 4), points, TAIL];
}

/** @param format of the file: `jpeg` or `png` */
export function compressedImage(
  stampNs: bigint,
  frame_id: string,
  format: string,
  data: Uint8Array,
): Uint8Array {
  return pictures.writeMessage({ timestamp: timeOf(stampNs), frame_id: cdrText(frame_id), data, format });
}

/** @param data H.264: an access unit as in Annex B, with its parameter sets if it is a key frame; VP8: a frame */
export function compressedVideo(
  stampNs: bigint,
  frame_id: string,
  format: VideoFormatName,
  data: Uint8Array,
): Uint8Array {
  return videos.writeMessage({ timestamp: timeOf(stampNs), frame_id: cdrText(frame_id), data, format });
}

export function transformOf(stampNs: bigint, child: string, { position, orientation }: Pose): Uint8Array {
  return transforms.writeMessage({
    transforms: [
      {
        header: headerOf(stampNs, WORLD_FRAME),
        child_frame_id: child,
        transform: { translation: position, rotation: orientation },
      },
    ],
  });
}

export function twistStamped(stampNs: bigint, twist: Twist): Uint8Array {
  return velocities(twist, stampNs, BASE_FRAME);
}

export function odometryOf(stampNs: bigint, pose: Pose, twist: Twist): Uint8Array {
  return odometry.writeMessage({
    header: headerOf(stampNs, WORLD_FRAME),
    child_frame_id: BASE_FRAME,
    pose: { pose, covariance: NO_COVARIANCE },
    twist: { twist, covariance: NO_COVARIANCE },
  });
}

/** @param name of what says it */
export function logLine(stampNs: bigint, name: string, message: string): Uint8Array {
  const timestamp = timeOf(stampNs);
  const texts = { message: cdrText(message), name: cdrText(name), file: '' };
  return logLines.writeMessage({ timestamp, level: INFO, ...texts, line: 0 });
}
