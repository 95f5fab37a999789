import { RTCP_PAYLOAD_FEEDBACK } from './remb.ts';
import { RTCP_TRANSPORT_FEEDBACK } from './transport-feedback.ts';

/** The common part of feedback packets: RTCP's header, SSRC of the sender and of the media source (RFC 4585 §6.1), bytes. */
export const FEEDBACK_HEADER_BYTES = 12;

/**
 * The stream that an RTCP feedback packet is about: the SSRC of the media source in its header (packet types 205 and
 * 206, RFC 4585 §6.1). A packet that names streams in its body instead has 0 here: a FIR, or a REMB.
 *
 * @param bytes one RTCP packet, including its header
 * @returns `null` if it is no feedback packet, or too short for one
 */
export function mediaSsrcOf(bytes: Uint8Array): number | null {
  if (bytes.byteLength < FEEDBACK_HEADER_BYTES || (bytes[0] as number) >> 6 !== 2) return null;
  const packetType = bytes[1] as number;
  if (packetType !== RTCP_TRANSPORT_FEEDBACK && packetType !== RTCP_PAYLOAD_FEEDBACK) return null;
  return new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength).getUint32(8);
}
