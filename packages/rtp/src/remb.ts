/** Receiver estimated maximum bit rate (RTCP type 206, FMT 15; draft-alvestrand-rmcat-remb-03 §2.2). */

export const RTCP_PAYLOAD_FEEDBACK = 206;
export const FMT_APPLICATION = 15;

/** The feedback header, identifier, count and rate, bytes. */
const FIXED_BYTES = 20;
const IDENTIFIER = 0x52454d42; // "REMB"

/** @returns bit/s over all the streams that it names; `null` if it is no such message */
export function readRemb(bytes: Uint8Array): number | null {
  if (bytes.byteLength < FIXED_BYTES) return null;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (view.getUint32(12) !== IDENTIFIER) return null;
  if (bytes.byteLength < FIXED_BYTES + 4 * view.getUint8(16)) return null;
  const word = view.getUint32(16) & 0xffffff;
  return (word & 0x3ffff) * 2 ** (word >> 18);
}
