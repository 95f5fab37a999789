/** The VP8 payload descriptor in front of every RTP payload of a VP8 frame (RFC 7741 §4.2). */

/** Length of the descriptor that {@link writeVp8Descriptor} writes. */
export const VP8_DESCRIPTOR_BYTES = 4;

export interface Vp8Descriptor {
  /** Length of the descriptor, bytes: 1–6. */
  bytes: number;
  /** The payload begins a frame: bit S, with partition 0. */
  beginsFrame: boolean;
  /** 7 or 15 bits; −1 if there is none. */
  pictureId: number;
}

export function emptyVp8Descriptor(): Vp8Descriptor {
  return { bytes: 0, beginsFrame: false, pictureId: -1 };
}

/**
 * Writes a descriptor with a 15-bit picture id (bits X, I and M) and partition 0.
 *
 * @param pictureId the lower 15 bits count
 */
export function writeVp8Descriptor(
  into: Uint8Array,
  at: number,
  beginsFrame: boolean,
  pictureId: number,
): void {
  into[at] = beginsFrame ? 0x90 : 0x80;
  into[at + 1] = 0x80;
  into[at + 2] = 0x80 | ((pictureId >> 8) & 0x7f);
  into[at + 3] = pictureId;
}

/** @returns false if the payload ends inside the descriptor, or with it */
export function readVp8Descriptor(payload: Uint8Array, into: Vp8Descriptor): boolean {
  const first = payload[0] ?? 0;
  into.beginsFrame = (first & 0x17) === 0x10;
  into.pictureId = -1;
  let at = 1;
  if ((first & 0x80) !== 0) {
    const extensions = payload[at++] ?? 0;
    if ((extensions & 0x80) !== 0) {
      const id = payload[at++] ?? 0;
      into.pictureId = id & 0x7f;
      if ((id & 0x80) !== 0) into.pictureId = (into.pictureId << 8) | (payload[at++] ?? 0);
    }
    if ((extensions & 0x40) !== 0) at++; // TL0PICIDX
    if ((extensions & 0x30) !== 0) at++; // TID, Y, KEYIDX
  }
  into.bytes = at;
  return at < payload.length;
}
