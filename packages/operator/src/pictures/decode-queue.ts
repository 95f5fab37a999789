import { MAX_CAMERAS, type PictureFormat, type WholePicture } from '@farpoint/protocol';

export interface PictureToDecode {
  /** Identifies the request; repeated in the answer. */
  ticket: number;
  format: PictureFormat;
  width: number;
  height: number;
  bytes: Uint8Array<ArrayBuffer>;
}

export type FromPictureWorker = { ticket: number; bitmap: ImageBitmap } | { ticket: number; fault: string };

interface Slot {
  decoding: { ticket: number; picture: WholePicture } | null;
  waiting: WholePicture | null;
}

/** Decodes one picture per camera at a time; only the newest waits. Slow machines show fewer pictures, not old ones. */
export class DecodeQueue {
  /** Pictures that were replaced by newer ones before they were decoded. */
  superseded = 0;
  readonly #decode: (picture: PictureToDecode) => void;
  readonly #slots: Slot[] = Array.from({ length: MAX_CAMERAS }, () => ({ decoding: null, waiting: null }));
  #ticket = 0;

  constructor(decode: (picture: PictureToDecode) => void) {
    this.#decode = decode;
  }

  add(picture: WholePicture): void {
    const slot = this.#slots[picture.camera] as Slot;
    if (slot.decoding === null) this.#begin(slot, picture);
    else {
      if (slot.waiting !== null) this.superseded++;
      slot.waiting = picture;
    }
  }

  /** @returns the picture whose decoding ended; `null` if it was cleared in the meantime */
  ended(ticket: number): WholePicture | null {
    for (const slot of this.#slots) {
      if (slot.decoding?.ticket !== ticket) continue;
      const { picture } = slot.decoding;
      slot.decoding = null;
      const { waiting } = slot;
      slot.waiting = null;
      if (waiting !== null) this.#begin(slot, waiting);
      return picture;
    }
    return null;
  }

  /** The robot has changed: forgets the pictures that are being decoded or waiting. */
  clear(): void {
    for (const slot of this.#slots) Object.assign(slot, { decoding: null, waiting: null });
  }

  #begin(slot: Slot, picture: WholePicture): void {
    this.#ticket++;
    slot.decoding = { ticket: this.#ticket, picture };
    const { format, width, height, bytes } = picture;
    this.#decode({ ticket: this.#ticket, format, width, height, bytes });
  }
}
