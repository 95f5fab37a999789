/** The interface between a camera's encoder and what feeds it with pictures. */
import type { VideoProcess } from '@farpoint/video';

/** What takes a camera's pictures: the process that encodes them. */
export type FeedTarget = Pick<VideoProcess, 'takes' | 'pushFrame' | 'pushCoded'>;

export interface FeedEvents {
  /** @param fault why no picture comes, for people. The next encoded picture clears it. */
  onFault(fault: string): void;
}

/** Pictures on their way to an encoder, until it is closed. */
export interface Feed {
  close(): void;
}

/**
 * Memory for the pictures that are pushed to one process, without an allocation for each. A process takes a picture only
 * when it has read the one before, so two buffers are enough: one that it reads, and one that is filled.
 */
export class FrameRooms {
  #free = new Uint8Array(0);
  #taken = new Uint8Array(0);

  /** To be filled, and then pushed. */
  room(bytes: number): Uint8Array {
    if (this.#free.length < bytes) this.#free = new Uint8Array(bytes);
    return this.#free.subarray(0, bytes);
  }

  /** Call when the process has taken what was filled. */
  swap(): void {
    [this.#free, this.#taken] = [this.#taken, this.#free];
  }
}
