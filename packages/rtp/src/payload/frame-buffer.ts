/** Collects the bytes of one frame. Grows up to a limit and is used again for the next frame. */
export class FrameBuffer {
  readonly #maxBytes: number;
  #room = new Uint8Array(0);
  #length = 0;

  constructor(maxBytes: number) {
    this.#maxBytes = maxBytes;
  }

  clear(): void {
    this.#length = 0;
  }

  /** @returns false, and appends nothing, if the frame would exceed the limit */
  append(bytes: Uint8Array): boolean {
    const length = this.#length + bytes.length;
    if (length > this.#maxBytes) return false;
    if (length > this.#room.length) {
      const room = new Uint8Array(Math.min(this.#maxBytes, Math.max(length, 2 * this.#room.length, 4096)));
      room.set(this.#room.subarray(0, this.#length));
      this.#room = room;
    }
    this.#room.set(bytes, this.#length);
    this.#length = length;
    return true;
  }

  /** A view, valid until the next change. */
  get bytes(): Uint8Array {
    return this.#room.subarray(0, this.#length);
  }
}
