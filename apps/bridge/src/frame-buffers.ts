/**
 * Reusable memory for frames in progress. A frame takes about a megabyte, and allocating ten a second keeps the
 * garbage collector busy.
 */

import { bytesOfPoints } from '@farpoint/protocol';

export interface FrameBuffer {
  /** Has the requested length. Its previous contents may still be there. */
  readonly bytes: Uint8Array;
  /** One byte per point, all 0. */
  readonly seen: Uint8Array;
  readonly memory: FrameMemory;
}

interface FrameMemory {
  readonly bytes: Uint8Array;
  readonly seen: Uint8Array;
}

/** Extra room, so that slightly larger frames can reuse the memory. */
const SPARE = 1.25;

export class FrameBuffers {
  readonly #free: FrameMemory[] = [];
  readonly #most: number;

  /** @param most maximum number of free buffers to keep */
  constructor(most: number) {
    this.#most = most;
  }

  take(points: number): FrameBuffer {
    let memory = this.#free.pop();
    if (memory === undefined || memory.seen.length < points) {
      const room = Math.ceil(points * SPARE);
      memory = { bytes: new Uint8Array(bytesOfPoints(room)), seen: new Uint8Array(room) };
    }
    const seen = memory.seen.subarray(0, points).fill(0);
    return { bytes: memory.bytes.subarray(0, bytesOfPoints(points)), seen, memory };
  }

  /** Returns a buffer that is no longer in use. Call this once only. */
  giveBack({ memory }: FrameBuffer): void {
    if (this.#free.length < this.#most) this.#free.push(memory);
  }
}
