import { POINTS_PER_PACKET } from '@farpoint/protocol';
import { SharedFrame } from '../transport/shared-frame.ts';

/**
 * A frame as the reference profile sends it: whole packets only. It shares the other's buffer and holds it until it is let
 * go itself. Points beyond the last whole packet, the farthest, are left out.
 *
 * @param overheadBytes what the reference transport adds to each payload on the wire
 * @returns `null` where there is no whole packet. Its maker must `release` it
 */
export function toReferenceFrame(shared: SharedFrame, overheadBytes: number): SharedFrame | null {
  const packets = Math.floor(shared.frame.points / POINTS_PER_PACKET);
  if (packets === 0) return null;
  const held = shared.hold();
  const frame = { ...shared.frame, packets, points: packets * POINTS_PER_PACKET };
  return new SharedFrame(frame, overheadBytes, () => held.release());
}
