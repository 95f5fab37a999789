/** What the beginning of an encoded VP8 frame says (RFC 6386 §9.1). */

/** The frame tag; with start code and size in a key frame: bytes. */
const TAG_BYTES = 3;
const KEY_FRAME_BYTES = 10;

export interface Vp8FrameHeader {
  isKeyFrame: boolean;
  /** Pixels, before the scaling that the header may suggest; `null` in a frame that is no key frame. */
  size: { width: number; height: number } | null;
}

/**
 * Reads the frame tag and, in a key frame, start code and size.
 *
 * @returns `null` if the frame is too short for its header or its first partition, or if a key frame's start code is
 *   wrong
 */
export function readVp8FrameHeader(frame: Uint8Array): Vp8FrameHeader | null {
  if (frame.length < TAG_BYTES) return null;
  const tag = byte(frame, 0) | (byte(frame, 1) << 8) | (byte(frame, 2) << 16);
  const isKeyFrame = (tag & 1) === 0;
  const headerBytes = isKeyFrame ? KEY_FRAME_BYTES : TAG_BYTES;
  if (frame.length < headerBytes + (tag >> 5)) return null;
  if (!isKeyFrame) return { isKeyFrame, size: null };
  if (byte(frame, 3) !== 0x9d || byte(frame, 4) !== 0x01 || byte(frame, 5) !== 0x2a) return null;
  // The upper two bits of each are the suggested scaling.
  const width = byte(frame, 6) | ((byte(frame, 7) & 0x3f) << 8);
  const height = byte(frame, 8) | ((byte(frame, 9) & 0x3f) << 8);
  return { isKeyFrame, size: { width, height } };
}

/** Whether a decoder can begin with this frame. False for bytes that are no whole frame. */
export function isVp8KeyFrame(frame: Uint8Array): boolean {
  return readVp8FrameHeader(frame)?.isKeyFrame === true;
}

/** The size of a key frame, pixels; `null` for any other frame. */
export function vp8KeyFrameSize(frame: Uint8Array): { width: number; height: number } | null {
  return readVp8FrameHeader(frame)?.size ?? null;
}

function byte(bytes: Uint8Array, at: number): number {
  return bytes[at] as number;
}
