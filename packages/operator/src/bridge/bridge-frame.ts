/** Splits a frame from the bridge's streaming socket into the batches in which points go to the page. */
import {
  bytesOfPoints,
  LATENCY_TEST_COLOUR,
  MAX_POINT_DATA_BYTES,
  OPTICAL_IN_BODY,
  type Placement,
  POINTS_PER_PACKET,
  type PointPacketHeader,
  pointsOfBytes,
} from '@farpoint/protocol';
import { type Batch, SAMPLED_COVER } from '../cloud/batch.ts';
import type { ImageExtent } from '../cloud/image-extent.ts';

/**
 * The reference stream has no camera pose. This assumes a level camera at the height of a person's chest that looks
 * along x.
 */
export const DEFAULT_CAMERA_POSE = {
  position: { x: 0, y: 0, z: 1 },
  orientation: OPTICAL_IN_BODY,
};

const HOST_IS_LITTLE_ENDIAN = new Uint8Array(new Uint16Array([1]).buffer)[0] === 1;

export interface FrameSink {
  /** A batch that is not full, or `null`: then the rest of the frame is dropped. */
  next(): Batch | null;
}

export interface FrameOutcome {
  points: number;
  /** Points dropped because there was no batch for them. */
  dropped: number;
}

/**
 * Splits a frame into batches.
 *
 * @param message N × 3 int16 coordinates, then N × u16 colours, little-endian
 * @param receivedAtMs ms since the epoch
 * @returns `null` if the message is not a frame
 */
export function splitFrame(
  message: ArrayBuffer,
  frameNumber: number,
  receivedAtMs: number,
  extent: ImageExtent,
  sink: FrameSink,
): FrameOutcome | null {
  const total = pointsOfBytes(message.byteLength);
  if (!Number.isInteger(total) || total === 0 || !HOST_IS_LITTLE_ENDIAN) return null;
  const coordinates = new Int16Array(message, 0, total * 3);
  const colours = new Int16Array(message, total * 6, total);
  const view = new DataView(message);
  const placement: Placement = {
    pose: DEFAULT_CAMERA_POSE,
    captureTimeUs: 0,
    latencyTest: colours.every((colour) => colour === LATENCY_TEST_COLOUR),
    saturated: false,
    sensor: 0,
    format: 'points64',
  };
  const header: PointPacketHeader = {
    frameNumber,
    frameLength: bytesOfPoints(total),
    sequenceOffset: 0,
    sequenceLength: 0,
  };
  for (let first = 0; first < total; first += POINTS_PER_PACKET) {
    const batch = sink.next();
    if (batch === null) return { points: first, dropped: total - first };
    const count = Math.min(POINTS_PER_PACKET, total - first);
    header.sequenceOffset = bytesOfPoints(first);
    header.sequenceLength = Math.min(bytesOfPoints(count), MAX_POINT_DATA_BYTES);
    extent.add(frameNumber, view, first * 6, count);
    interleave(coordinates, colours, first, count, batch.points, batch.pointCount);
    const look = { imageExtent: extent.value, unit: 0.001, cover: SAMPLED_COVER };
    batch.add(header, placement, count, receivedAtMs, look);
  }
  return { points: total, dropped: 0 };
}

function interleave(
  coordinates: Int16Array,
  colours: Int16Array,
  first: number,
  count: number,
  into: Int16Array,
  at: number,
): void {
  for (let i = 0; i < count; i++) {
    const from = (first + i) * 3;
    const to = (at + i) * 4;
    into[to] = coordinates[from] as number;
    into[to + 1] = coordinates[from + 1] as number;
    into[to + 2] = coordinates[from + 2] as number;
    into[to + 3] = colours[first + i] as number;
  }
}
