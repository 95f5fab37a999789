/** points64 in plain JavaScript, as the baseline for the WASM codec. */
import type { SlotLayout } from '@farpoint/wasm-codec';

const POINTS_PER_PACKET = 150;

/** Packs the chosen points of a frame into slots. */
export function packPlainly(
  frame: Float32Array,
  frameBits: Uint32Array,
  chosen: Uint32Array,
  { stride, dataOffset }: SlotLayout,
  slots: DataView,
): void {
  for (
    let first = 0, begin = dataOffset;
    first < chosen.length;
    first += POINTS_PER_PACKET, begin += stride
  ) {
    const count = Math.min(POINTS_PER_PACKET, chosen.length - first);
    for (let i = 0; i < count; i++) {
      const at = (chosen[first + i] as number) * 4;
      slots.setInt16(begin + i * 6, millimetres(frame[at] as number), true);
      slots.setInt16(begin + i * 6 + 2, millimetres(frame[at + 1] as number), true);
      slots.setInt16(begin + i * 6 + 4, millimetres(frame[at + 2] as number), true);
      const rgba = frameBits[at + 3] as number;
      const colour = ((rgba & 0xfc) << 8) | ((rgba >>> 6) & 0x3f0) | ((rgba >>> 20) & 0xf);
      slots.setUint16(begin + count * 6 + i * 2, colour, true);
    }
  }
}

function millimetres(metres: number): number {
  const mm = metres * 1000;
  const rounded = mm < 0 ? Math.ceil(mm - 0.5) : Math.floor(mm + 0.5);
  return Math.max(-32767, Math.min(32767, rounded));
}

/** Unpacks slots into x, y, z and colour bits, four int16 per point. */
export function unpackPlainly(
  slots: DataView,
  counts: Uint16Array,
  packets: number,
  { stride, dataOffset }: SlotLayout,
  points: Int16Array,
): void {
  let to = 0;
  for (let packet = 0; packet < packets; packet++) {
    const begin = packet * stride + dataOffset;
    const count = counts[packet] as number;
    for (let i = 0; i < count; i++) {
      points[to++] = slots.getInt16(begin + i * 6, true);
      points[to++] = slots.getInt16(begin + i * 6 + 2, true);
      points[to++] = slots.getInt16(begin + i * 6 + 4, true);
      points[to++] = slots.getInt16(begin + count * 6 + i * 2, true);
    }
  }
}
