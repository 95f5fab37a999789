/**
 * What the peer must be told of messages that are given up (FORWARD TSN, RFC 3758 §3.5), until it has acknowledged
 * that: a packet that says so can be lost, too, and then the peer would wait for ever.
 */

/** Longer than most paths take for an answer, ms. */
const AGAIN_MS = 200;

/** A FORWARD TSN chunk. */
export interface Forward {
  cumulativeTsn: number;
  /** Number of each ordered stream's last message that is given up. */
  streams: [streamId: number, sequence: number][];
}

export class GivenUp<Chunk extends Forward> {
  #latest: Chunk | null = null;
  readonly #streams = new Map<number, number>();
  #toldMs = 0;

  /** Adds what was not acknowledged of earlier ones to a chunk that will be sent now. */
  onTold(chunk: Chunk, nowMs: number): void {
    for (const [streamId, sequence] of chunk.streams) this.#streams.set(streamId, sequence);
    chunk.streams = [...this.#streams];
    this.#latest = chunk;
    this.#toldMs = nowMs;
  }

  /**
   * @param acknowledged the last number that the peer has acknowledged in order
   * @returns a chunk to be sent again, `wait` if it is too early for that, `null` if the peer knows everything
   */
  due(acknowledged: number, nowMs: number): Chunk | 'wait' | null {
    const latest = this.#latest;
    if (latest === null) return null;
    const missing = (latest.cumulativeTsn - acknowledged) >>> 0;
    if (missing === 0 || missing >= 2 ** 31) {
      this.#latest = null;
      this.#streams.clear();
      return null;
    }
    if (nowMs - this.#toldMs < AGAIN_MS) return 'wait';
    this.#toldMs = nowMs;
    return latest;
  }
}
