/** Frames with known content, to check that a point arrives in its frame and place. */
import {
  bytesOfPoints,
  FULL_POINT_PACKET_BYTES,
  POINTS_PER_PACKET,
  pointsOfBytes,
  writePointPacketHeader,
} from '@farpoint/protocol';

/** The point at position `place` of frame `frame`. */
function knownPoint(frame: number, place: number): { x: number; y: number; z: number; colour: number } {
  return { x: frame & 0x7fff, y: place & 0x7fff, z: place >> 15, colour: (place * 31 + frame * 7) & 0xffff };
}

/**
 * The payloads of a frame whose points are {@link knownPoint}s; `points` may be a multiple of 150, as in the profile,
 * or not.
 */
export function knownFrame(frame: number, points: number): Uint8Array[] {
  const payloads: Uint8Array[] = [];
  for (let first = 0; first < points; first += POINTS_PER_PACKET) {
    const count = Math.min(POINTS_PER_PACKET, points - first);
    const payload = new Uint8Array(FULL_POINT_PACKET_BYTES);
    const view = new DataView(payload.buffer);
    writePointPacketHeader(view, 0, {
      frameNumber: frame,
      frameLength: bytesOfPoints(points),
      sequenceOffset: bytesOfPoints(first),
      sequenceLength: bytesOfPoints(count),
    });
    for (let i = 0; i < count; i++) {
      const { x, y, z, colour } = knownPoint(frame, first + i);
      view.setInt16(16 + 6 * i, x, true);
      view.setInt16(18 + 6 * i, y, true);
      view.setInt16(20 + 6 * i, z, true);
      view.setUint16(16 + 6 * count + 2 * i, colour, true);
    }
    payloads.push(payload);
  }
  return payloads;
}

export interface ReadFrame {
  frame: number;
  /** Positions of its points, in the order of the message. */
  places: number[];
  /** Points that are not from this frame, or have the wrong colour. */
  strays: number;
}

/** Reads a message of the streaming socket that was made from {@link knownFrame}s. */
export function readKnownFrame(message: Uint8Array): ReadFrame {
  const view = new DataView(message.buffer, message.byteOffset, message.byteLength);
  const points = pointsOfBytes(message.byteLength);
  const frame = points === 0 ? -1 : view.getInt16(0, true);
  const places: number[] = [];
  let strays = 0;
  for (let i = 0; i < points; i++) {
    const place = view.getInt16(6 * i + 2, true) + view.getInt16(6 * i + 4, true) * 0x8000;
    const { x, colour } = knownPoint(frame, place);
    if (view.getInt16(6 * i, true) !== x || view.getUint16(6 * points + 2 * i, true) !== colour) strays++;
    places.push(place);
  }
  return { frame, places, strays };
}
