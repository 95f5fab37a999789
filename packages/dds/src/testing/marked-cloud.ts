/** Reads the marks in a peer's cloud. */
import { RELIABLE_QOS } from '@farpoint/ros';

/** In order and without gaps if the publisher is reliable, too. */
export const CLOUD_QOS = { ...RELIABLE_QOS, depth: 5 };

const POINT_BYTES = 16;
const COLOUR_OFFSET = 12;
/** A frame’s colour is its number times this, modulo 2²⁴; because the factor is odd, the number can be recovered. */
const MIX = 0x9e3779;
const MASK = 0xffffff;
const UNMIX = inverse(MIX);

export interface MarkedCloud {
  /** Starts at 1. */
  number: number;
  /** When it was created, ms since 1970. */
  madeMs: number;
  /** Whether it contains colours of another frame. */
  torn: boolean;
}

/**
 * Reads a PointCloud2 of a peer without using any message reader.
 *
 * @param side points per row, and number of rows
 * @returns `null` if it does not contain as many points
 */
export function readMarkedCloud(bytes: Uint8Array, side: number): MarkedCloud | null {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const dataBytes = side * side * POINT_BYTES;
  // The data is followed by is_dense, one byte, and at most enough padding for a multiple of four.
  for (let after = 1; after <= 4; after++) {
    const begin = bytes.length - after - dataBytes;
    if (begin < 8 || view.getUint32(begin - 4, true) !== dataBytes) continue;
    const colour = view.getUint32(begin + COLOUR_OFFSET, true);
    const number = Math.imul(colour, UNMIX) & MASK;
    let torn = false;
    for (let at = begin + COLOUR_OFFSET; at < begin + dataBytes; at += POINT_BYTES)
      torn ||= view.getUint32(at, true) !== colour;
    return { number, madeMs: view.getInt32(4, true) * 1000 + view.getUint32(8, true) / 1e6, torn };
  }
  return null;
}

/** Modulo 2³², by Newton’s method: each step doubles the number of correct bits. */
function inverse(odd: number): number {
  let result = odd;
  for (let bits = 3; bits < 32; bits *= 2) result = Math.imul(result, 2 - Math.imul(odd, result));
  return result;
}
