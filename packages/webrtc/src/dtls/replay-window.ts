/**
 * Records which sequence numbers of an epoch have been received (RFC 6347 §4.1.2.6): a window of 64 numbers that slides
 * with the highest authentic one. Anything older than the window counts as received.
 */
export class ReplayWindow {
  #highest = -1;
  /** Bit n: `highest − n` was received. Two halves of 32 bits, because JavaScript shifts 32-bit numbers. */
  #low = 0;
  #high = 0;

  /** Call before decrypting a record; call {@link mark} once the record has proved authentic. */
  has(sequence: number): boolean {
    const age = this.#highest - sequence;
    if (age < 0) return false;
    if (age >= 64) return true;
    return age < 32 ? ((this.#low >>> age) & 1) === 1 : ((this.#high >>> (age - 32)) & 1) === 1;
  }

  mark(sequence: number): void {
    const ahead = sequence - this.#highest;
    if (ahead > 0) {
      this.#slide(ahead);
      this.#highest = sequence;
      this.#low = (this.#low | 1) >>> 0;
    } else if (ahead > -32) {
      this.#low = (this.#low | (1 << -ahead)) >>> 0;
    } else if (ahead > -64) {
      this.#high = (this.#high | (1 << (-ahead - 32))) >>> 0;
    }
  }

  #slide(by: number): void {
    if (by >= 64) {
      this.#low = 0;
      this.#high = 0;
    } else if (by >= 32) {
      this.#high = by === 32 ? this.#low : (this.#low << (by - 32)) >>> 0;
      this.#low = 0;
    } else {
      this.#high = ((this.#high << by) | (this.#low >>> (32 - by))) >>> 0;
      this.#low = (this.#low << by) >>> 0;
    }
  }
}
