/** A fixed number of equal buffers that travel between two threads and come back. */
export class BufferPool {
  readonly #free: ArrayBuffer[];
  readonly #bytes: number;
  readonly #count: number;
  #refused = 0;

  constructor(count: number, bytes: number) {
    this.#bytes = bytes;
    this.#count = count;
    this.#free = Array.from({ length: count }, () => new ArrayBuffer(bytes));
  }

  /** How many are here. */
  get free(): number {
    return this.#free.length;
  }

  /** How often `take` found none. */
  get refused(): number {
    return this.#refused;
  }

  /** A buffer, or `null` where all are out: the reader is behind. */
  take(): ArrayBuffer | null {
    const buffer = this.#free.pop() ?? null;
    if (buffer === null) this.#refused++;
    return buffer;
  }

  release(buffer: ArrayBuffer): void {
    if (buffer.byteLength === this.#bytes && this.#free.length < this.#count) this.#free.push(buffer);
  }
}
