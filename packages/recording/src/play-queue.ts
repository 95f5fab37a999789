import type { RecordedMessage } from './recording.ts';

/** Messages beside the clouds that may wait, bytes: eight cameras’ raw pictures of a tenth of a second. */
const MOST_BYTES = 128 * 1024 * 1024;

/**
 * What was read ahead and waits for its time, in the order of time: one cloud at most, and messages that are played along
 * with the clouds. Where those are too large, the oldest is dropped.
 */
export class PlayQueue {
  /** Messages played along that were dropped. */
  dropped = 0;
  readonly #mostBytes: number;
  readonly #waiting: RecordedMessage[] = [];
  #cloud: RecordedMessage | null = null;
  #bytes = 0;

  constructor(mostBytes = MOST_BYTES) {
    this.#mostBytes = mostBytes;
  }

  /** Of the cloud that waits. */
  get cloudNs(): bigint | null {
    return this.#cloud?.logNs ?? null;
  }

  /** The one before must have been taken. */
  pushCloud(message: RecordedMessage): void {
    this.#cloud = message;
    this.#insert(message);
  }

  /** Keeps a copy. @returns the oldest of those that had to go, `null` where there is room */
  pushAlong(message: RecordedMessage): RecordedMessage | null {
    this.#insert({ ...message, data: message.data.slice() });
    this.#bytes += message.data.length;
    let oldest: RecordedMessage | null = null;
    while (this.#bytes > this.#mostBytes) {
      const at = this.#waiting.findIndex((each) => each !== this.#cloud);
      const [gone] = this.#waiting.splice(at, 1) as [RecordedMessage];
      this.#bytes -= gone.data.length;
      this.dropped++;
      oldest ??= gone;
    }
    return oldest;
  }

  /** The oldest, where it is not newer than that. @param untilNs `null`: whatever its time */
  take(untilNs: bigint | null): { message: RecordedMessage; isCloud: boolean } | null {
    const message = this.#waiting[0];
    if (message === undefined || (untilNs !== null && message.logNs > untilNs)) return null;
    this.#waiting.shift();
    const isCloud = message === this.#cloud;
    if (isCloud) this.#cloud = null;
    else this.#bytes -= message.data.length;
    return { message, isCloud };
  }

  /** Files without an index give messages nearly, not always, in order. */
  #insert(message: RecordedMessage): void {
    let at = this.#waiting.length;
    while (at > 0 && (this.#waiting[at - 1] as RecordedMessage).logNs > message.logNs) at--;
    this.#waiting.splice(at, 0, message);
  }
}
