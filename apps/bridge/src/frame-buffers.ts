/** Memory for frames under way, used again: a frame is about a megabyte, and new ones ten times a second keep the collector busy. */

import { bytesOfPoints } from '@farpoint/protocol';

export interface FrameBuffer {
  /** As long as asked for. What was in it before may still be there. */
  readonly bytes: Uint8Array;
  /** One for each point, all 0. */
  readonly seen: Uint8Array;
  readonly memory: FrameMemory;
}

interface FrameMemory {
  readonly bytes: Uint8Array;
  readonly seen: Uint8Array;
}

/** Frames that are seldom larger than the last ones need no memory of their own. */
const SPARE = 1.25;

export class FrameBuffers {
  readonly #free: FrameMemory[] = [];
  readonly #most: number;

  /** @param most free ones that are kept */
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

  /** Nobody looks at it any more. Once only. */
  giveBack({ memory }: FrameBuffer): void {
    if (this.#free.length < this.#most) this.#free.push(memory);
  }
}
