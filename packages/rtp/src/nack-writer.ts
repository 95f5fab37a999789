import { FEEDBACK_HEADER_BYTES } from './feedback-header.ts';
import { FMT_GENERIC_NACK } from './nack.ts';
import { SequenceNumber } from './sequence-number.ts';
import { RTCP_TRANSPORT_FEEDBACK } from './transport-feedback.ts';

/**
 * Writes a generic NACK (nack.ts).
 *
 * @param missing RTP sequence numbers, 16 bits, in sending order; at least one
 */
export function writeNack(senderSsrc: number, mediaSsrc: number, missing: readonly number[]): Uint8Array {
  const entries: { first: number; more: number }[] = [];
  for (const sequence of missing) {
    const last = entries.at(-1);
    const ahead = last === undefined ? 0 : SequenceNumber.ahead(sequence, last.first);
    if (last !== undefined && ahead >= 1 && ahead <= 16) last.more |= 1 << (ahead - 1);
    else entries.push({ first: SequenceNumber.of(sequence), more: 0 });
  }
  const bytes = new Uint8Array(FEEDBACK_HEADER_BYTES + entries.length * 4);
  const view = new DataView(bytes.buffer);
  view.setUint8(0, 0x80 | FMT_GENERIC_NACK);
  view.setUint8(1, RTCP_TRANSPORT_FEEDBACK);
  view.setUint16(2, bytes.length / 4 - 1);
  view.setUint32(4, senderSsrc);
  view.setUint32(8, mediaSsrc);
  for (const [i, { first, more }] of entries.entries()) {
    view.setUint16(FEEDBACK_HEADER_BYTES + i * 4, first);
    view.setUint16(FEEDBACK_HEADER_BYTES + i * 4 + 2, more);
  }
  return bytes;
}
