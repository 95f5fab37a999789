import type { RecordedMessage } from './recording.ts';

/** Limit on waiting messages besides the clouds, bytes: a tenth of a second of raw pictures from eight cameras. */
const MOST_BYTES = 128 * 1024 * 1024;

/**
 * What was read ahead and waits for its time, in order of time: at most one cloud, and accompanying messages. If these
 * take too much memory, the oldest is dropped.
 */
export class PlayQueue {
  /** Accompanying messages that were dropped. */
  dropped = 0;
  readonly #mostBytes: number;
  readonly #waiting: RecordedMessage[] = [];
  #cloud: RecordedMessage | null = null;
  #bytes = 0;

  constructor(mostBytes = MOST_BYTES) {
    this.#mostBytes = mostBytes;
  }

  /** Time of the waiting cloud. */
  get cloudNs(): bigint | null {
    return this.#cloud?.logNs ?? null;
  }

  /** The previous cloud must have been taken. */
  pushCloud(message: RecordedMessage): void {
    this.#cloud = message;
    this.#insert(message);
  }

  /** Keeps a copy. @returns the oldest of the messages that were dropped for it, `null` if none was */
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

  /** Takes the oldest message if it is not newer than `untilNs`. @param untilNs `null` for any time */
  take(untilNs: bigint | null): { message: RecordedMessage; isCloud: boolean } | null {
    const message = this.#waiting[0];
    if (message === undefined || (untilNs !== null && message.logNs > untilNs)) return null;
    this.#waiting.shift();
    const isCloud = message === this.#cloud;
    if (isCloud) this.#cloud = null;
    else this.#bytes -= message.data.length;
    return { message, isCloud };
  }

  /** Files without an index return messages nearly, but not always, in order. */
  #insert(message: RecordedMessage): void {
    let at = this.#waiting.length;
    while (at > 0 && (this.#waiting[at - 1] as RecordedMessage).logNs > message.logNs) at--;
    this.#waiting.splice(at, 0, message);
  }
}
