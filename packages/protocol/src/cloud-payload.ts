/** The payload of our own profile: a point packet and its placement, nothing before, between or after. */
import { PLACEMENT_BYTES, type Placement, type PlacementFault, readPlacement } from './placement.ts';
import {
  MAX_POINT_DATA_BYTES,
  POINT_PACKET_HEADER_BYTES,
  type PointPacketFault,
  type PointPacketHeader,
  readPointPacketHeader,
} from './point-packet.ts';

export const MAX_CLOUD_PAYLOAD_BYTES = POINT_PACKET_HEADER_BYTES + MAX_POINT_DATA_BYTES + PLACEMENT_BYTES;

/** Why a payload is dropped. */
export type CloudPayloadFault = PointPacketFault | PlacementFault | 'trailing-bytes';

/**
 * Reads and checks header and placement into the given objects (nothing is allocated).
 *
 * @returns what is wrong, or `null`; on `null` the data block is `header.sequenceLength` bytes from byte 16
 */
export function readCloudPayload(
  view: DataView,
  header: PointPacketHeader,
  placement: Placement,
): CloudPayloadFault | null {
  // The format byte first: data of another format need not have our header.
  const fault = readPlacement(view, placement) ?? readPointPacketHeader(view, header);
  if (fault !== null) return fault;
  const expected = POINT_PACKET_HEADER_BYTES + header.sequenceLength + PLACEMENT_BYTES;
  if (view.byteLength < expected) return 'too-short';
  return view.byteLength > expected ? 'trailing-bytes' : null;
}
