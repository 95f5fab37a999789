import { POINTS_PER_PACKET } from '@farpoint/protocol';
import { SharedFrame } from '../../send/transport/shared-frame.ts';

/**
 * A frame as the reference profile sends it: whole packets only. It shares the original frame's buffer and holds it
 * until it is released itself. It leaves out the points beyond the last whole packet, which are the farthest.
 *
 * @param overheadBytes bytes that the reference transport adds to each payload on the wire
 * @returns `null` if there is no whole packet. The caller must `release` the frame
 */
export function toReferenceFrame(shared: SharedFrame, overheadBytes: number): SharedFrame | null {
  const packets = Math.floor(shared.frame.points / POINTS_PER_PACKET);
  if (packets === 0) return null;
  const held = shared.hold();
  const frame = { ...shared.frame, packets, points: packets * POINTS_PER_PACKET };
  return new SharedFrame(frame, overheadBytes, () => held.release());
}
