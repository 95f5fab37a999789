/** Reads point fields that are aligned words. Nearly every driver uses such a layout, and most time is spent here. */
import type { PointField } from './messages.ts';

/** Axes of a cloud's frame (REP-103): optical (z forward, x right, y down) or body (x forward, y left, z up). */
export type CloudAxes = 'optical' | 'body';

/** Layout of the points in the data. */
export interface Rows {
  width: number;
  height: number;
  rowBytes: number;
  step: number;
}

/** The data as words; copied if it is not aligned. */
export function alignedWords(data: Uint8Array): Float32Array {
  const bytes = data.byteOffset % 4 === 0 ? data : data.slice();
  return new Float32Array(bytes.buffer, bytes.byteOffset, bytes.length >> 2);
}

/** Copies one word of each point, one after the other. */
export function copyWords(
  words: Float32Array,
  { width, height, rowBytes, step }: Rows,
  offset: number,
  into: Float32Array,
): void {
  const stride = step >> 2;
  let to = 0;
  for (let row = 0; row < height; row++) {
    let at = ((row * rowBytes) >> 2) + offset;
    for (let i = 0; i < width; i++, at += stride) into[to++] = words[at] as number;
  }
}

/** Converts ROS's packed colours to R, G, B, A. */
export function copyColours(
  source: Uint32Array,
  { width, height, rowBytes, step }: Rows,
  offset: number,
  into: Uint32Array,
  intoStride: number,
  first: number,
): void {
  const stride = step >> 2;
  let to = first;
  for (let row = 0; row < height; row++) {
    let at = ((row * rowBytes) >> 2) + offset;
    for (let i = 0; i < width; i++, at += stride, to += intoStride) {
      const argb = source[at] as number;
      into[to] = ((argb >> 16) & 0xff) | (argb & 0xff00) | ((argb & 0xff) << 16) | 0xff00_0000;
    }
  }
}

/** Copies x, y and z of each point, rotated into optical axes; the fourth word is left unchanged. */
export function copyPoints(
  words: Float32Array,
  { width, height, rowBytes, step }: Rows,
  fields: readonly [PointField, PointField, PointField],
  axes: CloudAxes,
  into: Float32Array,
): void {
  const [x, y, z] = fields.map((field) => field.offset >> 2) as [number, number, number];
  const stride = step >> 2;
  let to = 0;
  for (let row = 0; row < height; row++) {
    let at = (row * rowBytes) >> 2;
    for (let i = 0; i < width; i++, at += stride, to += 4) {
      if (axes === 'optical') {
        into[to] = words[at + x] as number;
        into[to + 1] = words[at + y] as number;
        into[to + 2] = words[at + z] as number;
      } else {
        into[to] = -(words[at + y] as number);
        into[to + 1] = -(words[at + z] as number);
        into[to + 2] = words[at + x] as number;
      }
    }
  }
}

/** Visits points row by row. @param visit gets the point's first byte and its number */
export function forEachPoint(
  { width, height, rowBytes, step }: Rows,
  visit: (at: number, index: number) => void,
): void {
  let index = 0;
  for (let row = 0; row < height; row++) {
    let at = row * rowBytes;
    for (let i = 0; i < width; i++, at += step) visit(at, index++);
  }
}
