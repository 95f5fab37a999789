/**
 * The payload of our own profile: a point packet and its placement, nothing before, between or after.
 *
 * For coded formats, the header describes the decoded points: frameLength, sequenceOffset and sequenceLength count 8
 * bytes per point, as for `points64`, and a packet may hold more than 150 points. A receiver thus knows a packet's
 * place in the frame in every format.
 */
import { PLACEMENT_BYTES, type Placement, type PlacementFault, readPlacement } from './placement.ts';
import {
  MAX_POINT_DATA_BYTES,
  POINT_PACKET_HEADER_BYTES,
  type PointPacketFault,
  type PointPacketHeader,
  readPointPacketHeader,
  readPointPlace,
} from './point-packet.ts';

export const MAX_CLOUD_PAYLOAD_BYTES = POINT_PACKET_HEADER_BYTES + MAX_POINT_DATA_BYTES + PLACEMENT_BYTES;

/** Why a payload is dropped. */
export type CloudPayloadFault = PointPacketFault | PlacementFault | 'trailing-bytes';

/**
 * Reads and checks header and placement into the given objects, without allocating.
 *
 * @returns what is wrong, or `null`; on `null`, the data extends from byte 16 to the placement, 28 bytes before the end
 */
export function readCloudPayload(
  view: DataView,
  header: PointPacketHeader,
  placement: Placement,
): CloudPayloadFault | null {
  // The format byte first: data in an unknown format need not have our header.
  const trailerFault = readPlacement(view, placement);
  if (trailerFault !== null) return trailerFault;
  if (placement.format !== 'points64') {
    const dataBytes = view.byteLength - POINT_PACKET_HEADER_BYTES - PLACEMENT_BYTES;
    if (dataBytes <= 0) return 'too-short';
    if (dataBytes > MAX_POINT_DATA_BYTES) return 'trailing-bytes';
    return readPointPlace(view, header);
  }
  const fault = readPointPacketHeader(view, header);
  if (fault !== null) return fault;
  const expected = POINT_PACKET_HEADER_BYTES + header.sequenceLength + PLACEMENT_BYTES;
  if (view.byteLength < expected) return 'too-short';
  return view.byteLength > expected ? 'trailing-bytes' : null;
}
