/**
 * `points64`: the mandatory point layout, 64 bits per point. A data block of n ≤ 150 points is n × (x, y, z as int16
 * millimetres) in its first 6n bytes, then n × u16 6-6-4 colour. For n = 150, this is the reference system's block.
 *
 * These functions are the readable definition of the format and its conformance reference. Peers that process many
 * points use the WASM codec, which gives the same bytes.
 */
import { LATENCY_TEST_COLOUR } from './colour664.ts';
import { pointsOfBytes } from './point-packet.ts';

export const MAX_COORDINATE_MM = 32767;

/** Metres to int16 millimetres: rounded half away from zero, saturating at ±32767, never wrapped. */
export function quantiseMillimetres(metres: number): number {
  const mm = metres * 1000;
  const rounded = mm < 0 ? Math.ceil(mm - 0.5) : Math.floor(mm + 0.5);
  if (rounded > MAX_COORDINATE_MM) return MAX_COORDINATE_MM;
  if (rounded < -MAX_COORDINATE_MM) return -MAX_COORDINATE_MM;
  return rounded;
}

export function isSaturated(metres: number): boolean {
  return Math.abs(metres) * 1000 >= MAX_COORDINATE_MM + 0.5;
}

/**
 * Writes one data block of `count` points at `offset`.
 *
 * @param positions x, y, z in metres for each point, finite
 * @param colours 6-6-4 colours
 * @param first index of the first point in both arrays
 * @returns how many points had a coordinate beyond ±32.767 m
 */
export function writePoints64Block(
  view: DataView,
  offset: number,
  positions: Float32Array,
  colours: Uint16Array,
  first: number,
  count: number,
): number {
  let saturated = 0;
  const colourOffset = offset + count * 6;
  for (let i = 0; i < count; i++) {
    const p = (first + i) * 3;
    const x = positions[p] as number;
    const y = positions[p + 1] as number;
    const z = positions[p + 2] as number;
    if (isSaturated(x) || isSaturated(y) || isSaturated(z)) saturated++;
    view.setInt16(offset + i * 6, quantiseMillimetres(x), true);
    view.setInt16(offset + i * 6 + 2, quantiseMillimetres(y), true);
    view.setInt16(offset + i * 6 + 4, quantiseMillimetres(z), true);
    view.setUint16(colourOffset + i * 2, colours[first + i] as number, true);
  }
  return saturated;
}

/**
 * Reads one data block into interleaved int16 x, y, z (millimetres) and colour bits: the renderer's vertex layout.
 *
 * @param length bytes of the block, 8 × points
 * @param into room for 4 × points from `at`
 * @returns the number of points
 */
export function readPoints64Block(
  view: DataView,
  offset: number,
  length: number,
  into: Int16Array,
  at: number,
): number {
  const count = pointsOfBytes(length);
  const colourOffset = offset + count * 6;
  for (let i = 0; i < count; i++) {
    const to = at + i * 4;
    into[to] = view.getInt16(offset + i * 6, true);
    into[to + 1] = view.getInt16(offset + i * 6 + 2, true);
    into[to + 2] = view.getInt16(offset + i * 6 + 4, true);
    into[to + 3] = view.getInt16(colourOffset + i * 2, true);
  }
  return count;
}

/** Whether every colour of a block is the latency test's green. */
export function isLatencyTestBlock(view: DataView, offset: number, length: number): boolean {
  const count = pointsOfBytes(length);
  const colourOffset = offset + count * 6;
  for (let i = 0; i < count; i++) {
    if (view.getUint16(colourOffset + i * 2, true) !== LATENCY_TEST_COLOUR) return false;
  }
  return count > 0;
}
