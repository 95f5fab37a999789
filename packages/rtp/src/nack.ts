/**
 * Generic NACK (RTPFB, packet type 205, FMT 1; RFC 4585 §6.2.1): the RTP packets that a receiver of a stream misses.
 */
import { FEEDBACK_HEADER_BYTES } from './feedback-header.ts';
import { SequenceNumber } from './sequence-number.ts';
import { RTCP_TRANSPORT_FEEDBACK } from './transport-feedback.ts';

export const FMT_GENERIC_NACK = 1;

/** Why a NACK is refused. */
export type NackFault = 'not-nack' | 'truncated' | 'bad-length';

/**
 * Reads one RTCP packet: header, SSRC of sender and media source, then any number of u16 PID (a sequence number) and
 * u16 BLP (bit i: sequence number PID + i + 1 is missing too). `mediaSsrcOf` (feedback-header.ts) says of which stream.
 *
 * @param onMissing called with each missing sequence number, 16 bits
 * @returns why the packet cannot be read, in which case `onMissing` is not called; `null` if it is valid
 */
export function readNack(bytes: Uint8Array, onMissing: (sequence: number) => void): NackFault | null {
  if (bytes.byteLength < FEEDBACK_HEADER_BYTES + 4) return 'truncated';
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const first = view.getUint8(0);
  if (first >> 6 !== 2 || (first & 0x1f) !== FMT_GENERIC_NACK || view.getUint8(1) !== RTCP_TRANSPORT_FEEDBACK)
    return 'not-nack';
  // No padding: all fields are whole words.
  if ((view.getUint16(2) + 1) * 4 !== bytes.byteLength || (first & 0x20) !== 0) return 'bad-length';
  for (let at = FEEDBACK_HEADER_BYTES; at < bytes.byteLength; at += 4) {
    const sequence = view.getUint16(at);
    onMissing(sequence);
    const more = view.getUint16(at + 2);
    for (let bit = 0; bit < 16; bit++) {
      if ((more & (1 << bit)) !== 0) onMissing(SequenceNumber.add(sequence, bit + 1));
    }
  }
  return null;
}
