/** Adds header and placement to the data that a codec has written to a frame's slots. */
import {
  bytesOfPoints,
  MAX_POINT_DATA_BYTES,
  PLACEMENT_BYTES,
  type Placement,
  POINT_PACKET_HEADER_BYTES,
  POINT_PACKET_OFFSETS,
  packetCountOf,
  pointsOfBytes,
  writePlacement,
  writePointPacketHeader,
} from '@farpoint/protocol';

/**
 * Room for one packet: header, data and placement (at most 1244 bytes), and the payload's length in the last two
 * bytes.
 */
export const SLOT_BYTES = 1248;
/** Offset of the codec's data in a slot. */
export const SLOT_DATA_OFFSET = POINT_PACKET_HEADER_BYTES;
const LENGTH_OFFSET = SLOT_BYTES - 2;

/** The payload of a slot, without a copy. */
export function slotPayload(slots: Uint8Array, index: number): Uint8Array {
  const at = index * SLOT_BYTES;
  return slots.subarray(at, at + slotPayloadBytes(slots, index));
}

export function slotPayloadBytes(slots: Uint8Array, index: number): number {
  const at = index * SLOT_BYTES + LENGTH_OFFSET;
  return (slots[at] as number) | ((slots[at + 1] as number) << 8);
}

/** The sequence offset of a slot's packet within its frame, from its header. */
export function slotSequenceOffset(slots: Uint8Array, index: number): number {
  const header = new DataView(slots.buffer, slots.byteOffset + index * SLOT_BYTES);
  return header.getUint32(POINT_PACKET_OFFSETS.sequenceOffset, true);
}

/** Completes the packets of one frame in place. The caller says how many points and bytes of data each slot holds. */
export class Packetiser {
  readonly #header = { frameNumber: 0, frameLength: 0, sequenceOffset: 0, sequenceLength: 0 };
  #view: DataView = new DataView(new ArrayBuffer(0));
  #placement: Placement | null = null;
  #count = 0;
  #point = 0;

  /**
   * @param slots packet i starts at byte i × SLOT_BYTES; its data is already at SLOT_DATA_OFFSET
   * @param points number of points in the whole frame
   */
  begin(slots: Uint8Array, frameNumber: number, points: number, placement: Placement): void {
    this.#view = new DataView(slots.buffer, slots.byteOffset, slots.byteLength);
    this.#header.frameNumber = frameNumber;
    this.#header.frameLength = bytesOfPoints(points);
    this.#placement = placement;
    this.#count = 0;
    this.#point = 0;
  }

  /** Completes the next slot. */
  add(points: number, dataBytes: number): void {
    const at = this.#count * SLOT_BYTES;
    const header = this.#header;
    header.sequenceOffset = bytesOfPoints(this.#point);
    header.sequenceLength = bytesOfPoints(points);
    writePointPacketHeader(this.#view, at, header);
    writePlacement(this.#view, at + SLOT_DATA_OFFSET + dataBytes, this.#placement as Placement);
    this.#view.setUint16(at + LENGTH_OFFSET, SLOT_DATA_OFFSET + dataBytes + PLACEMENT_BYTES, true);
    this.#point += points;
    this.#count++;
  }
}

/**
 * Completes a whole frame of `points64`.
 *
 * @returns the number of packets
 */
export function completePackets(
  slots: Uint8Array,
  frameNumber: number,
  points: number,
  placement: Placement,
  packetiser = new Packetiser(),
): number {
  packetiser.begin(slots, frameNumber, points, placement);
  const packets = packetCountOf(points);
  for (let i = 0; i < packets; i++) {
    const bytes = Math.min(MAX_POINT_DATA_BYTES, bytesOfPoints(points) - i * MAX_POINT_DATA_BYTES);
    packetiser.add(pointsOfBytes(bytes), bytes);
  }
  return packets;
}
