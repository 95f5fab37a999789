/** Puts header and placement around the data blocks that the codec has left in a frame's slots. */
import {
  BYTES_PER_POINT,
  MAX_POINT_DATA_BYTES,
  PLACEMENT_BYTES,
  type Placement,
  POINT_PACKET_HEADER_BYTES,
  packetCountOf,
  writePlacement,
  writePointPacketHeader,
} from '@farpoint/protocol';

/** One packet's room: header, block and placement (1244 bytes), rounded up to a multiple of 8. */
export const SLOT_BYTES = 1248;
const FULL_PAYLOAD_BYTES = POINT_PACKET_HEADER_BYTES + MAX_POINT_DATA_BYTES + PLACEMENT_BYTES;

/** Bytes of a frame's packet `index` of `packets`, the frame having `points` points. */
export function payloadBytes(points: number, index: number): number {
  const rest = points * BYTES_PER_POINT - index * MAX_POINT_DATA_BYTES;
  return rest >= MAX_POINT_DATA_BYTES
    ? FULL_PAYLOAD_BYTES
    : POINT_PACKET_HEADER_BYTES + rest + PLACEMENT_BYTES;
}

/** Bytes of all of a frame's payloads together. */
export function framePayloadBytes(points: number): number {
  return points * BYTES_PER_POINT + packetCountOf(points) * (POINT_PACKET_HEADER_BYTES + PLACEMENT_BYTES);
}

/**
 * Completes the packets of one frame in place.
 *
 * @param slots packet i at byte i × SLOT_BYTES, its data block already at byte 16 of it
 * @returns the number of packets
 */
export function completePackets(
  slots: Uint8Array,
  frameNumber: number,
  points: number,
  placement: Placement,
): number {
  const view = new DataView(slots.buffer, slots.byteOffset, slots.byteLength);
  const frameLength = points * BYTES_PER_POINT;
  const packets = packetCountOf(points);
  const header = { frameNumber, frameLength, sequenceOffset: 0, sequenceLength: 0 };
  for (let i = 0; i < packets; i++) {
    const at = i * SLOT_BYTES;
    header.sequenceOffset = i * MAX_POINT_DATA_BYTES;
    header.sequenceLength = Math.min(MAX_POINT_DATA_BYTES, frameLength - header.sequenceOffset);
    writePointPacketHeader(view, at, header);
    writePlacement(view, at + POINT_PACKET_HEADER_BYTES + header.sequenceLength, placement);
  }
  return packets;
}
