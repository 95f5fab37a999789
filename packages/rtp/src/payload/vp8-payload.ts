/** Splits VP8 frames into RTP payloads (RFC 7741). */
import { checkPayloadLimit, VideoPayloadError } from './video-payload-error.ts';
import { VP8_DESCRIPTOR_BYTES, writeVp8Descriptor } from './vp8-descriptor.ts';

/**
 * Makes the payloads of one frame, in sending order: each a descriptor (§4.2) and a piece of the frame. The RTP marker
 * belongs to the last one.
 *
 * @param frame one encoded frame
 * @param pictureId increases by one for each frame; its lower 15 bits are sent
 * @param maxPayloadBytes longest payload, without the RTP header; at least 5
 * @returns views of one new buffer
 * @throws {VideoPayloadError}
 */
export function packetiseVp8(frame: Uint8Array, pictureId: number, maxPayloadBytes: number): Uint8Array[] {
  checkPayloadLimit(maxPayloadBytes, VP8_DESCRIPTOR_BYTES + 1);
  if (frame.length === 0) throw new VideoPayloadError('empty', 'the frame has no bytes');
  const pieceBytes = maxPayloadBytes - VP8_DESCRIPTOR_BYTES;
  const pieces = Math.ceil(frame.length / pieceBytes);
  const room = new Uint8Array(frame.length + pieces * VP8_DESCRIPTOR_BYTES);
  const payloads: Uint8Array[] = [];
  for (let from = 0, begin = 0; from < frame.length; from += pieceBytes, begin += maxPayloadBytes) {
    const piece = frame.subarray(from, from + pieceBytes);
    writeVp8Descriptor(room, begin, from === 0, pictureId);
    room.set(piece, begin + VP8_DESCRIPTOR_BYTES);
    payloads.push(room.subarray(begin, begin + VP8_DESCRIPTOR_BYTES + piece.length));
  }
  return payloads;
}
