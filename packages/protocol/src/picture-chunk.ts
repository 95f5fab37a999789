/**
 * One message of the `pictures` channel: a piece of a camera's picture, little-endian.
 *
 *     0  u8  format           1 JPEG, 2 PNG
 *     1  u8  camera           place in the list of `cameras` (session-messages.ts)
 *     2  u16 width            pixels, as the picture's own header says
 *     4  u16 height
 *     6  u16 index            of this chunk
 *     8  u16 count            chunks of the picture
 *    10  u16 reserved         0, passed over
 *    12  u32 pictureId        counts up for each picture of this camera, wraps
 *    16  u32 captureTimeUs    of the robot's monotonic clock, wraps, as in a placement
 *    20      data             1,140 bytes, of the last chunk 1 to 1,140
 *
 * A chunk is one SCTP packet: usual stacks keep those to 1,191 bytes, and a message of 1,161 would go as two.
 */

/** The layout above, bytes. */
export const PICTURE_CHUNK_HEADER_BYTES = 20;
export const MAX_PICTURE_CHUNK_BYTES = 1160;
export const PICTURE_CHUNK_DATA_BYTES = MAX_PICTURE_CHUNK_BYTES - PICTURE_CHUNK_HEADER_BYTES;
/** Chunks of a picture. Chosen: a receiver keeps less than 600 kB for each camera. */
export const MAX_PICTURE_CHUNKS = 512;
/** 583,680 bytes. */
export const MAX_PICTURE_BYTES = MAX_PICTURE_CHUNKS * PICTURE_CHUNK_DATA_BYTES;
/** Longest side of a picture, pixels. */
export const MAX_PICTURE_SIDE = 4096;
/** Maximum number of cameras of a robot. */
export const MAX_CAMERAS = 8;

export const PICTURE_FORMATS = ['jpeg', 'png'] as const;
export type PictureFormat = (typeof PICTURE_FORMATS)[number];

/** What every chunk of a picture repeats about it. */
export interface PictureHeader {
  format: PictureFormat;
  camera: number;
  width: number;
  height: number;
  pictureId: number;
  captureTimeUs: number;
}

export interface PictureChunkHeader extends PictureHeader {
  index: number;
  count: number;
}

/** Why a chunk is refused. */
export type PictureChunkFault =
  | 'too-short' // no complete header, or no data after it
  | 'too-long' // more than 1,160 bytes
  | 'unknown-format'
  | 'bad-camera' // the camera number exceeds the maximum
  | 'bad-size' // a side of 0 or over 4,096 pixels
  | 'bad-index' // no chunks, too many, or an index out of range
  | 'bad-length'; // not the last chunk, but not full

export function emptyPictureChunkHeader(): PictureChunkHeader {
  return {
    format: 'jpeg',
    camera: 0,
    width: 0,
    height: 0,
    index: 0,
    count: 0,
    pictureId: 0,
    captureTimeUs: 0,
  };
}

/** The number of chunks for a picture of this many bytes. */
export function pictureChunks(bytes: number): number {
  return Math.ceil(bytes / PICTURE_CHUNK_DATA_BYTES);
}

/**
 * Writes one chunk of a picture.
 *
 * @param picture the whole picture, 1 to {@link MAX_PICTURE_BYTES} bytes
 * @param into room for {@link MAX_PICTURE_CHUNK_BYTES}
 * @returns the length of the chunk, bytes
 */
export function writePictureChunk(
  header: PictureHeader,
  picture: Uint8Array,
  index: number,
  into: Uint8Array,
): number {
  const view = new DataView(into.buffer, into.byteOffset, into.byteLength);
  view.setUint8(0, PICTURE_FORMATS.indexOf(header.format) + 1);
  view.setUint8(1, header.camera);
  view.setUint16(2, header.width, true);
  view.setUint16(4, header.height, true);
  view.setUint16(6, index, true);
  view.setUint16(8, pictureChunks(picture.length), true);
  view.setUint16(10, 0);
  view.setUint32(12, header.pictureId, true);
  view.setUint32(16, header.captureTimeUs >>> 0, true);
  const begin = index * PICTURE_CHUNK_DATA_BYTES;
  const data = picture.subarray(begin, begin + PICTURE_CHUNK_DATA_BYTES);
  into.set(data, PICTURE_CHUNK_HEADER_BYTES);
  return PICTURE_CHUNK_HEADER_BYTES + data.length;
}

/**
 * Reads and checks a chunk's header into `into`, without allocating. Returns what is wrong with it, or `null`.
 *
 * @param view the whole message
 */
export function readPictureChunk(view: DataView, into: PictureChunkHeader): PictureChunkFault | null {
  const dataBytes = view.byteLength - PICTURE_CHUNK_HEADER_BYTES;
  if (dataBytes < 1) return 'too-short';
  if (dataBytes > PICTURE_CHUNK_DATA_BYTES) return 'too-long';
  const format = PICTURE_FORMATS[view.getUint8(0) - 1];
  if (format === undefined) return 'unknown-format';
  into.format = format;
  into.camera = view.getUint8(1);
  if (into.camera >= MAX_CAMERAS) return 'bad-camera';
  into.width = view.getUint16(2, true);
  into.height = view.getUint16(4, true);
  if (Math.min(into.width, into.height) === 0 || Math.max(into.width, into.height) > MAX_PICTURE_SIDE)
    return 'bad-size';
  into.index = view.getUint16(6, true);
  into.count = view.getUint16(8, true);
  if (into.count > MAX_PICTURE_CHUNKS || into.index >= into.count) return 'bad-index';
  if (into.index < into.count - 1 && dataBytes < PICTURE_CHUNK_DATA_BYTES) return 'bad-length';
  into.pictureId = view.getUint32(12, true);
  into.captureTimeUs = view.getUint32(16, true);
  return null;
}
