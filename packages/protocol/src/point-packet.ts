/**
 * One RTP payload of a point cloud: a 16-byte header and up to 1200 bytes of point data, little-endian.
 *
 *     0  u32 frameNumber      counts up frame by frame, wraps; from 0 for each connection in the reference profile
 *     4  u32 frameLength      bytes of point data in the whole frame
 *     8  u32 sequenceOffset   where in the frame's point data this packet's block begins
 *    12  u32 sequenceLength   bytes of point data in this packet
 *    16  point data           see points64.ts
 *
 * Every packet can be decoded alone. The layout is the reference system's; in its own profile the payload is always
 * zero-padded to 1216 bytes, in ours it ends with a placement trailer (placement.ts).
 */

/**
 * The label of the point packets' m-line. Browsers refuse unknown payloads, so the points are labelled as audio; the
 * receiver's transform takes each packet before anything is decoded.
 */
export const CLOUD_MEDIA = { kind: 'audio', mimeType: 'audio/opus', clockRate: 48_000, channels: 2 } as const;

/** The only m-line of the reference profile: `5 pcm/90000`, with the transport-wide sequence number as extension 1. */
export const REFERENCE_MEDIA = {
  kind: 'video',
  mimeType: 'video/pcm',
  clockRate: 90_000,
  payloadType: 5,
  extensionId: 1,
} as const;

/** Four fields, bytes. */
export const POINT_PACKET_HEADER_BYTES = 16;
/** int16 x, y, z and 16 bits of colour. */
export const BYTES_PER_POINT = 8;
export const POINTS_PER_PACKET = 150;
export const MAX_POINT_DATA_BYTES = bytesOfPoints(POINTS_PER_PACKET);
/** Header and a full data block: the reference profile always sends this length. */
export const FULL_POINT_PACKET_BYTES = POINT_PACKET_HEADER_BYTES + MAX_POINT_DATA_BYTES;
/** Where the header's fields are, as bytes from its beginning; each is a little-endian u32. */
export const POINT_PACKET_OFFSETS = {
  frameNumber: 0,
  frameLength: 4,
  sequenceOffset: 8,
  sequenceLength: 12,
} as const;
/** More points than any supported camera has; a frame that claims more is refused. */
export const MAX_POINTS_PER_FRAME = 4_194_304;

export interface PointPacketHeader {
  frameNumber: number;
  frameLength: number;
  sequenceOffset: number;
  sequenceLength: number;
}

/** Why a point packet is dropped. */
export type PointPacketFault =
  | 'too-short' // no room for the header, or for the data that the header claims
  | 'bad-length' // sequenceLength is 0, over 1200 or not whole points
  | 'bad-frame-length' // frameLength is not whole points, or over the limit
  | 'bad-offset'; // the block does not lie within the frame, or not on a point boundary

export function emptyPointPacketHeader(): PointPacketHeader {
  return { frameNumber: 0, frameLength: 0, sequenceOffset: 0, sequenceLength: 0 };
}

/** Writes the 16 bytes at `offset`, where the view must have room. */
export function writePointPacketHeader(view: DataView, offset: number, header: PointPacketHeader): void {
  view.setUint32(offset + POINT_PACKET_OFFSETS.frameNumber, header.frameNumber, true);
  view.setUint32(offset + POINT_PACKET_OFFSETS.frameLength, header.frameLength, true);
  view.setUint32(offset + POINT_PACKET_OFFSETS.sequenceOffset, header.sequenceOffset, true);
  view.setUint32(offset + POINT_PACKET_OFFSETS.sequenceLength, header.sequenceLength, true);
}

/**
 * Reads and checks a header into `into`, without allocating. Returns what is wrong with it, or `null`.
 *
 * @param view the whole payload
 */
export function readPointPacketHeader(view: DataView, into: PointPacketHeader): PointPacketFault | null {
  const fault = readPointPlace(view, into);
  if (fault === 'too-short') return fault;
  if (into.sequenceLength > MAX_POINT_DATA_BYTES) return 'bad-length';
  if (fault !== null) return fault;
  if (view.byteLength < POINT_PACKET_HEADER_BYTES + into.sequenceLength) return 'too-short';
  return null;
}

/** The same for a header whose data is coded: any number of points, in any number of bytes. */
export function readPointPlace(view: DataView, into: PointPacketHeader): PointPacketFault | null {
  if (view.byteLength < POINT_PACKET_HEADER_BYTES) return 'too-short';
  into.frameNumber = view.getUint32(POINT_PACKET_OFFSETS.frameNumber, true);
  into.frameLength = view.getUint32(POINT_PACKET_OFFSETS.frameLength, true);
  into.sequenceOffset = view.getUint32(POINT_PACKET_OFFSETS.sequenceOffset, true);
  into.sequenceLength = view.getUint32(POINT_PACKET_OFFSETS.sequenceLength, true);
  const { frameLength, sequenceOffset, sequenceLength } = into;
  if (sequenceLength === 0 || sequenceLength % BYTES_PER_POINT !== 0) return 'bad-length';
  if (frameLength % BYTES_PER_POINT !== 0 || frameLength > bytesOfPoints(MAX_POINTS_PER_FRAME)) {
    return 'bad-frame-length';
  }
  if (sequenceOffset % BYTES_PER_POINT !== 0 || sequenceOffset + sequenceLength > frameLength) {
    return 'bad-offset';
  }
  return null;
}

/** Bytes of point data that `points` points take, as the header counts them in every format. */
export function bytesOfPoints(points: number): number {
  return points * BYTES_PER_POINT;
}

/** How many points the header means by so many bytes of point data. Whole for every header that was read without a fault. */
export function pointsOfBytes(bytes: number): number {
  return bytes / BYTES_PER_POINT;
}

/** How many packets a frame of `points` points takes. */
export function packetCountOf(points: number): number {
  return Math.ceil(points / POINTS_PER_PACKET);
}
