/** A fixed number of buffers of equal size that travel to another thread and come back. */
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

  /** Number of buffers that are available. */
  get free(): number {
    return this.#free.length;
  }

  /** How often no buffer was available. */
  get refused(): number {
    return this.#refused;
  }

  /** Whether a buffer is available for work that is to begin now; work that cannot begin is counted as refused. */
  admits(): boolean {
    if (this.#free.length > 0) return true;
    this.#refused++;
    return false;
  }

  /** Takes a buffer; `null` if none is available because the reader is behind. */
  take(): ArrayBuffer | null {
    const buffer = this.#free.pop() ?? null;
    if (buffer === null) this.#refused++;
    return buffer;
  }

  release(buffer: ArrayBuffer): void {
    if (buffer.byteLength === this.#bytes && this.#free.length < this.#count) this.#free.push(buffer);
  }
}
