/**
 * Reads messages that hold a picture, from ROS and Foxglove, live or recorded, into the form in which sources give
 * pictures.
 */

import type { SourcePicture } from '@farpoint/cloud-source';
import {
  compressedImageSchema,
  compressedPicture,
  FOXGLOVE_COMPRESSED_IMAGE_TYPES,
  FOXGLOVE_RAW_IMAGE_TYPES,
  foxgloveCompressedImageSchema,
  foxgloveRawImageSchema,
  imageSchema,
  stampNs,
} from '@farpoint/ros';

export type PictureMessage = Pick<SourcePicture, 'facts' | 'data'> & { stampNs: bigint };
type ReadMessage = (message: unknown) => PictureMessage;

const READERS: ReadonlyMap<string, ReadMessage> = new Map([
  ['sensor_msgs/msg/Image', readImage],
  ['sensor_msgs/msg/CompressedImage', readCompressed],
  ...FOXGLOVE_RAW_IMAGE_TYPES.map((type) => [type, readFoxgloveRaw] as const),
  ...FOXGLOVE_COMPRESSED_IMAGE_TYPES.map((type) => [type, readFoxgloveCompressed] as const),
]);

/** Types of messages that hold a picture. CDR types are named as in ROS 2; JSON and Protobuf types as they are. */
export const PICTURE_TYPES: readonly string[] = [...READERS.keys()];

/**
 * @param type one of {@link PICTURE_TYPES}
 * @param message decoded; the returned picture shares its data
 * @throws {Error} if the message does not match its type, {@link RosFault} for a file that is neither JPEG nor PNG
 */
export function readPicture(type: string, message: unknown): PictureMessage {
  const read = READERS.get(type);
  if (read === undefined) throw new Error(`${type || 'an unknown type'} holds no picture`);
  return read(message);
}

function readImage(message: unknown): PictureMessage {
  const { header, width, height, step, encoding, is_bigendian, data } = imageSchema.parse(message);
  const facts = { kind: 'raw', width, height, step, encoding, bigEndian: Boolean(is_bigendian) } as const;
  return { stampNs: stampNs(header.stamp), facts, data };
}

function readCompressed(message: unknown): PictureMessage {
  const { header, format, data } = compressedImageSchema.parse(message);
  return {
    stampNs: stampNs(header.stamp),
    facts: { kind: 'file', ...compressedPicture({ format, data }) },
    data,
  };
}

function readFoxgloveRaw(message: unknown): PictureMessage {
  const { timestamp, width, height, step, encoding, data } = foxgloveRawImageSchema.parse(message);
  const facts = { kind: 'raw', width, height, step, encoding, bigEndian: false } as const;
  return { stampNs: stampNs(timestamp), facts, data };
}

function readFoxgloveCompressed(message: unknown): PictureMessage {
  const { timestamp, format, data } = foxgloveCompressedImageSchema.parse(message);
  return {
    stampNs: stampNs(timestamp),
    facts: { kind: 'file', ...compressedPicture({ format, data }) },
    data,
  };
}
