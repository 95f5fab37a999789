import type { CapturedRecord } from './recorder-messages.ts';

/** Size of one point in PointCloud2: x, y, z as float32 in metres, then a packed colour (0x00RRGGBB). */
export const RECORDED_POINT_BYTES = 16;

/** Reusable memory for clouds: megabytes per frame are too much for the garbage collector. */
export class PointRoom {
  #words = new Uint32Array(0);

  /** Room for this many points of four words each, valid until the next call. */
  take(points: number): Uint32Array {
    if (this.#words.length < points * 4) this.#words = new Uint32Array(Math.ceil(points * 1.25) * 4);
    return this.#words.subarray(0, points * 4);
  }
}

/**
 * A captured cloud in that layout: in its own memory if it came as points, else in `room`. NaN for pixels without
 * depth.
 */
export function recordedPoints(record: CapturedRecord, room: PointRoom): Uint8Array {
  if (record.type === 'points') {
    const words = new Uint32Array(record.buffer, 0, record.count * 4);
    for (let i = 3; i < words.length; i += 4) words[i] = rgbOf(words[i] as number);
    return new Uint8Array(record.buffer, 0, words.byteLength);
  }
  const { width, height, lens } = record;
  const pixels = width * height;
  const depth = new Float32Array(record.buffer, 0, pixels);
  const colour = new Uint32Array(record.buffer, pixels * 4, pixels);
  const words = room.take(pixels);
  const points = new Float32Array(words.buffer, words.byteOffset, words.length);
  for (let v = 0, i = 0; v < height; v++) {
    const y = (v - lens.cy) / lens.fy;
    for (let u = 0; u < width; u++, i++) {
      const metres = depth[i] as number;
      const z = metres > 0 && metres < Number.POSITIVE_INFINITY ? metres : Number.NaN;
      points[i * 4] = ((u - lens.cx) / lens.fx) * z;
      points[i * 4 + 1] = y * z;
      points[i * 4 + 2] = z;
      words[i * 4 + 3] = rgbOf(colour[i] as number);
    }
  }
  return new Uint8Array(words.buffer, words.byteOffset, words.byteLength);
}

/** Converts from R in the lowest byte to ROS's packed colour. */
function rgbOf(rgba: number): number {
  return ((rgba & 0xff) << 16) | (rgba & 0xff00) | ((rgba >> 16) & 0xff);
}
