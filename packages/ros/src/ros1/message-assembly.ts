/** Assembles messages of a TCPROS stream in reusable memory: each follows its length in four bytes, little-endian. */

/** Longer messages are refused: a cloud of 10 million points is shorter. */
export const MOST_MESSAGE_BYTES = 512 * 1024 * 1024;
const LENGTH_BYTES = 4;

export class MessageAssembly {
  readonly #onMessage: (framed: Uint8Array) => void;
  #room = new Uint8Array(64 * 1024);
  #filled = 0;

  /** @param onMessage gets each message preceded by its length, valid only during the call */
  constructor(onMessage: (framed: Uint8Array) => void) {
    this.#onMessage = onMessage;
  }

  /**
   * @param chunk the next bytes, which may be overwritten after the call
   * @throws {RangeError} if a message would be too long: nothing that follows can be read
   */
  add(chunk: Uint8Array): void {
    for (let at = 0; at < chunk.length; ) {
      const needed = this.#needed();
      const taken = Math.min(needed - this.#filled, chunk.length - at);
      this.#reserve(this.#filled + taken, needed);
      this.#room.set(chunk.subarray(at, at + taken), this.#filled);
      this.#filled += taken;
      at += taken;
      if (this.#filled < LENGTH_BYTES || this.#filled < this.#needed()) continue;
      this.#filled = 0;
      this.#onMessage(this.#room.subarray(0, needed));
    }
  }

  /** Length of the present message, including its length field; before that is known, the size of the field. */
  #needed(): number {
    if (this.#filled < LENGTH_BYTES) return LENGTH_BYTES;
    const length = new DataView(this.#room.buffer).getUint32(0, true);
    if (length > MOST_MESSAGE_BYTES)
      throw new RangeError(`a message of ${length} bytes, at most ${MOST_MESSAGE_BYTES} are read`);
    return LENGTH_BYTES + length;
  }

  /** Grows with the bytes that arrive, not with the claimed length: whoever claims much must send much. */
  #reserve(bytes: number, needed: number): void {
    if (this.#room.length >= bytes) return;
    const room = new Uint8Array(Math.max(bytes, Math.min(needed, this.#room.length * 2)));
    room.set(this.#room.subarray(0, this.#filled));
    this.#room = room;
  }
}
