/**
 * A picture's capture time inside its bitstream: it survives relays that rewrite RTP timestamps, header extensions and
 * sender reports. Decoders skip it.
 */
import type { VideoCodec } from './video-media.ts';

/** Tells the stamp from other data of an application, as an SEI message of this kind requires (ITU-T H.264 D.1.7). */
const UUID = Uint8Array.of(
  0x9c,
  0x5e,
  0xd1,
  0x47,
  0xb8,
  0x32,
  0x4f,
  0x6a,
  0xa1,
  0x7d,
  0xe3,
  0x58,
  0x26,
  0xcb,
  0x94,
  0xf5,
);
/** 64 bits in groups of 7. */
const TIME_BYTES = 10;
/** Length of the stamp, bytes. */
export const CAPTURE_STAMP_BYTES = UUID.length + TIME_BYTES;

const SEI = 6;
const USER_DATA_UNREGISTERED = 5;
/** Where a stamp may begin in an H.264 access unit, at most: parameter sets may come before it. */
const MOST_BEFORE = 512;
const MOST_NS = (1n << 64n) - 1n;

/**
 * Writes a stamp. None of its bytes is below 4, so that no H.264 start code can occur in it, and no byte need be escaped.
 *
 * @param captureNs on the robot's monotonic clock, ns, modulo 2⁶⁴
 */
export function writeCaptureStamp(captureNs: bigint): Uint8Array {
  const bytes = new Uint8Array(CAPTURE_STAMP_BYTES);
  bytes.set(UUID);
  let rest = captureNs & MOST_NS;
  for (let at = CAPTURE_STAMP_BYTES - 1; at >= UUID.length; at--) {
    bytes[at] = 0x80 | Number(rest & 0x7fn);
    rest >>= 7n;
  }
  return bytes;
}

/** The stamp as an H.264 NAL unit: an SEI message with unregistered user data, without a start code. */
export function captureStampNal(captureNs: bigint): Uint8Array {
  const stamp = writeCaptureStamp(captureNs);
  const trailingBits = 0x80;
  return Uint8Array.of(SEI, USER_DATA_UNREGISTERED, CAPTURE_STAMP_BYTES, ...stamp, trailingBits);
}

/**
 * Reads the stamp of an encoded picture: in H.264 the SEI message before the first slice, in VP8 the last bytes.
 *
 * @param picture an access unit as Annex B, or a VP8 frame
 * @returns ns on the robot's monotonic clock; `null` if the picture has no stamp
 */
export function readCaptureStamp(picture: Uint8Array, codec: VideoCodec): bigint | null {
  if (codec === 'VP8') return stampAt(picture, picture.length - CAPTURE_STAMP_BYTES);
  const last = Math.min(picture.length - CAPTURE_STAMP_BYTES, MOST_BEFORE);
  for (let at = 3; at <= last; at++) {
    const isHeader =
      picture[at - 1] === CAPTURE_STAMP_BYTES &&
      picture[at - 2] === USER_DATA_UNREGISTERED &&
      ((picture[at - 3] as number) & 0x1f) === SEI;
    if (!isHeader) continue;
    const captureNs = stampAt(picture, at);
    if (captureNs !== null) return captureNs;
  }
  return null;
}

function stampAt(bytes: Uint8Array, at: number): bigint | null {
  if (at < 0) return null;
  for (let i = 0; i < UUID.length; i++) if (bytes[at + i] !== UUID[i]) return null;
  let captureNs = 0n;
  for (let i = UUID.length; i < CAPTURE_STAMP_BYTES; i++) {
    const byte = bytes[at + i] as number;
    if (byte < 0x80) return null;
    captureNs = (captureNs << 7n) | BigInt(byte & 0x7f);
  }
  return captureNs <= MOST_NS ? captureNs : null;
}
