/**
 * Requests for a key frame, RTCP packet type 206: picture loss indication (PLI: FMT 1, RFC 4585 §6.3.1) and full intra
 * request (FIR: FMT 4, RFC 5104 §4.3.1).
 */
import { FEEDBACK_HEADER_BYTES } from './feedback-header.ts';
import { RTCP_PAYLOAD_FEEDBACK } from './remb.ts';

export const FMT_PICTURE_LOSS = 1;
export const FMT_FULL_INTRA = 4;

/** SSRC, command number, three bytes reserved (RFC 5104 §4.3.1.1). */
const FIR_ENTRY_BYTES = 8;

/** Why a request is refused. */
export type PictureLossFault = 'not-picture-loss' | 'truncated' | 'bad-length';

/**
 * Reads one RTCP packet. A PLI names one stream in its header. A FIR names any number in its body, each with a command
 * number: a FIR with the same number as the one before is a repetition.
 *
 * @param onRequest called with the SSRC of each stream whose key frame is requested, and the FIR's command number, 8
 *   bits; `null` for a PLI
 * @returns why the packet cannot be read, in which case `onRequest` is not called; `null` if it is valid
 */
export function readPictureLoss(
  bytes: Uint8Array,
  onRequest: (mediaSsrc: number, firNumber: number | null) => void,
): PictureLossFault | null {
  if (bytes.byteLength < FEEDBACK_HEADER_BYTES) return 'truncated';
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const first = view.getUint8(0);
  const format = first & 0x1f;
  const isKnown = format === FMT_PICTURE_LOSS || format === FMT_FULL_INTRA;
  if (first >> 6 !== 2 || !isKnown || view.getUint8(1) !== RTCP_PAYLOAD_FEEDBACK) return 'not-picture-loss';
  // No padding: all fields are whole words.
  if ((view.getUint16(2) + 1) * 4 !== bytes.byteLength || (first & 0x20) !== 0) return 'bad-length';
  const bodyBytes = bytes.byteLength - FEEDBACK_HEADER_BYTES;
  if (format === FMT_PICTURE_LOSS) {
    if (bodyBytes !== 0) return 'bad-length';
    onRequest(view.getUint32(8), null);
    return null;
  }
  if (bodyBytes === 0 || bodyBytes % FIR_ENTRY_BYTES !== 0) return 'bad-length';
  for (let at = FEEDBACK_HEADER_BYTES; at < bytes.byteLength; at += FIR_ENTRY_BYTES) {
    onRequest(view.getUint32(at), view.getUint8(at + 4));
  }
  return null;
}

/** Writes a PLI. */
export function writePictureLoss(senderSsrc: number, mediaSsrc: number): Uint8Array {
  const bytes = new Uint8Array(FEEDBACK_HEADER_BYTES);
  const view = new DataView(bytes.buffer);
  view.setUint8(0, 0x80 | FMT_PICTURE_LOSS);
  view.setUint8(1, RTCP_PAYLOAD_FEEDBACK);
  view.setUint16(2, FEEDBACK_HEADER_BYTES / 4 - 1);
  view.setUint32(4, senderSsrc);
  view.setUint32(8, mediaSsrc);
  return bytes;
}
