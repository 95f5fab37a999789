/**
 * How much work a decrypted compound RTCP packet (RFC 3550 §6.1) makes. The unit is a packet of it, or as much as that
 * costs of what a packet lists: feedback names up to 65,535 packets in 40 bytes.
 */
import {
  FMT_TRANSPORT_WIDE,
  RTCP_RECEIVER_REPORT,
  RTCP_SENDER_REPORT,
  RTCP_TRANSPORT_FEEDBACK,
} from '@farpoint/rtp';

/** The first word of each packet: format, type and length (RFC 3550 §6.4.1). */
const HEADER_BYTES = 4;
/** Where transport-wide feedback says on how many packets it reports. */
const STATUS_COUNT_AT = 14;
/** What costs as much as a packet. Chosen: a packet with more is counted as several. */
const STATUSES_PER_UNIT = 256;
const BYTES_PER_UNIT = 64;

/** No path takes more. */
export const MAX_COMPOUND_BYTES = 2048;
/** A browser sends a report, a description, and feedback on each of its streams. */
export const MAX_PARTS = 64;

/** @returns `null` if the compound is longer, or has more parts, than any receiver has to say */
export function compoundWork(compound: Buffer): number | null {
  if (compound.length > MAX_COMPOUND_BYTES) return null;
  let parts = 0;
  let work = Math.floor(compound.length / BYTES_PER_UNIT);
  for (let at = 0; at + HEADER_BYTES <= compound.length; at = partEnd(compound, at)) {
    if (++parts > MAX_PARTS) return null;
    const isFeedback =
      compound.readUInt8(at + 1) === RTCP_TRANSPORT_FEEDBACK &&
      (compound.readUInt8(at) & 0x1f) === FMT_TRANSPORT_WIDE &&
      at + STATUS_COUNT_AT + 2 <= compound.length;
    if (isFeedback) work += Math.floor(compound.readUInt16BE(at + STATUS_COUNT_AT) / STATUSES_PER_UNIT);
  }
  return work + Math.max(1, parts);
}

/**
 * The report that a compound begins with, of which werift needs to know. It reads each other part up to the end of the
 * compound, so that many of them take the square of their number.
 */
export function leadingReport(compound: Buffer): Buffer {
  const type = compound[1];
  if (compound.length < HEADER_BYTES || (type !== RTCP_SENDER_REPORT && type !== RTCP_RECEIVER_REPORT))
    return compound.subarray(0, 0);
  return compound.subarray(0, partEnd(compound, 0));
}

function partEnd(compound: Buffer, at: number): number {
  return at + (compound.readUInt16BE(at + 2) + 1) * 4;
}
