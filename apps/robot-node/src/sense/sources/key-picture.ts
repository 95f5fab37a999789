/** Whether a coded picture can be decoded without any other. */

const IDR_SLICE = 5;
const FIRST_SLICE = 1;

/** @param bytes H.264: an access unit as in Annex B; VP8: a frame (RFC 6386 §9.1) */
export function isKeyPicture(coding: 'h264' | 'vp8', bytes: Uint8Array): boolean {
  if (coding === 'vp8') return bytes.length > 0 && ((bytes[0] as number) & 1) === 0;
  for (let i = 0; i + 3 < bytes.length; i++) {
    if (bytes[i] !== 0 || bytes[i + 1] !== 0 || bytes[i + 2] !== 1) continue;
    const type = (bytes[i + 3] as number) & 0x1f;
    if (type === IDR_SLICE) return true;
    // All slices of an access unit are of a kind.
    if (type === FIRST_SLICE) return false;
    i += 2;
  }
  return false;
}
