import { CodecError } from './errors.ts';

/** Points of a full packet. */
export const POINTS_PER_PACKET = 150;
/** int16 x, y, z and 16 bits of colour. */
export const BYTES_PER_POINT = 8;

/**
 * Layout of a frame's data blocks: packet i's block begins at byte `i × stride + dataOffset`. The bytes before and
 * after it in the slot are left unchanged: room for a packet's header and trailer.
 */
export interface SlotLayout {
  stride: number;
  dataOffset: number;
}

/** A 16-byte header before a full block of 1200 bytes, and room for a 28-byte trailer after it. */
export const DEFAULT_SLOT_LAYOUT: SlotLayout = { stride: 1248, dataOffset: 16 };

/** How many packets a frame of `points` points takes. */
export function packetsFor(points: number): number {
  return Math.ceil(points / POINTS_PER_PACKET);
}

/** @throws CodecError `bad-layout` */
export function checkSlotLayout({ stride, dataOffset }: SlotLayout): void {
  const whole = Number.isInteger(stride) && Number.isInteger(dataOffset);
  if (
    !whole ||
    dataOffset < 0 ||
    stride < dataOffset + POINTS_PER_PACKET * BYTES_PER_POINT ||
    stride > 65_536
  ) {
    throw new CodecError(
      'bad-layout',
      `a block of 1200 bytes at offset ${dataOffset} does not fit into slots of ${stride} bytes`,
    );
  }
}

/** Far above any sensor's frame; keeps the buffers well inside a 32-bit memory. */
const MAX_CAPACITY = 16_777_216;

/** @throws CodecError `bad-capacity` */
export function checkCapacity(name: string, capacity: number): void {
  if (!Number.isInteger(capacity) || capacity < 1 || capacity > MAX_CAPACITY) {
    throw new CodecError(
      'bad-capacity',
      `${name} is ${capacity}, not a whole number from 1 to ${MAX_CAPACITY}`,
    );
  }
}
