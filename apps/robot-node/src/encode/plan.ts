/** How many points of a frame to send (the paper's equations 2 and 3), with the bit rate counted on the wire. */
import {
  MAX_POINT_DATA_BYTES,
  PLACEMENT_BYTES,
  POINT_PACKET_HEADER_BYTES,
  POINTS_PER_PACKET,
} from '@farpoint/protocol';
import { maxPoints } from '@farpoint/wasm-codec';

export interface PlanInput {
  /** What the stream may take on the wire, all headers counted, bit/s. */
  targetBitsPerSecond: number;
  framesPerSecond: number;
  /** Points of the raw cloud. */
  rawPoints: number;
  /** Bytes that the transport adds to each payload: RTP, SRTP, UDP, IP. */
  overheadBytes: number;
  /** Equation 3's fraction of the raw cloud a second that is sent whatever the rate. */
  floorFraction: number;
  /** The operator's or the configuration's own limit of points a frame. */
  mostPoints: number;
}

/** @returns whole packets' worth of points, at most `mostPoints` rounded down to whole packets */
export function planPoints(input: PlanInput): number {
  const { targetBitsPerSecond, framesPerSecond, rawPoints, overheadBytes, floorFraction, mostPoints } = input;
  const wireBytes = POINT_PACKET_HEADER_BYTES + MAX_POINT_DATA_BYTES + PLACEMENT_BYTES + overheadBytes;
  const planned = maxPoints({
    // Of each packet's bytes on the wire only the points count for the equation.
    bitsPerSecond: (targetBitsPerSecond * MAX_POINT_DATA_BYTES) / wireBytes,
    framesPerSecond,
    points: rawPoints,
    floorFraction,
  });
  return Math.min(planned, Math.floor(mostPoints / POINTS_PER_PACKET) * POINTS_PER_PACKET);
}
