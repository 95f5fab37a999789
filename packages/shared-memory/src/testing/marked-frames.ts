/** Frames in which every part identifies its frame, so that a mixture of two is detected. */
import { POINTS_PER_PACKET, pointsOfBytes } from '@farpoint/protocol';
import type { CloudFrame, FrameRoom } from '../cloud/cloud-reader.ts';

/** How many different marks there are. */
const MARKS = 30_000;

/** Fills points of 16 bytes for Farpoint's layout: every word follows from the mark and its own index. */
export function fillWords(words: Uint32Array, mark: number): void {
  const base = Math.imul(mark, 0x9e37_79b1);
  for (let i = 0; i < words.length; i++) words[i] = base + i;
}

/** Whether all points of a frame have the mark of the first. */
export function areWordsWhole({ points }: CloudFrame, room: FrameRoom): boolean {
  const words = new Uint32Array(room.points.buffer, room.points.byteOffset, points * 4);
  const base = words[0] as number;
  for (let i = 0; i < words.length; i++) if (words[i] !== (base + i) >>> 0) return false;
  return true;
}

/** Fills the reference system's packed points: x, z and colour are the mark, y follows from mark and index. */
export function fillPacked(packed: Uint8Array, mark: number): void {
  const values = new Int16Array(packed.buffer, packed.byteOffset, packed.length / 2);
  const of = mark % MARKS;
  const points = pointsOfBytes(packed.length);
  for (let first = 0; first < points; first += POINTS_PER_PACKET) {
    const count = Math.min(POINTS_PER_PACKET, points - first);
    const at = first * 4;
    for (let i = 0; i < count; i++) {
      values[at + i * 3] = of;
      values[at + i * 3 + 1] = (of + first + i) % MARKS;
      values[at + i * 3 + 2] = of;
      values[at + count * 3 + i] = of;
    }
  }
}

/** @param points as unpacked, 4 floats each */
export function arePackedWhole(points: Float32Array, count: number): boolean {
  if (count === 0) return true;
  const words = new Uint32Array(points.buffer, points.byteOffset, count * 4);
  const x = points[0] as number;
  const mark = Math.round(x * 1000);
  const colour = words[3] as number;
  for (let i = 0; i < count; i++) {
    const at = i * 4;
    if (points[at] !== x || points[at + 2] !== x || words[at + 3] !== colour) return false;
    if (Math.round((points[at + 1] as number) * 1000) !== (mark + i) % MARKS) return false;
  }
  return true;
}
