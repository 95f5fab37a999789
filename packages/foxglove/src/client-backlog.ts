/** A message on its way to clients. Several clients share its bytes. */
export interface LiveMessage {
  channel: number;
  /** ns since 1970. */
  ns: bigint;
  bytes: Uint8Array;
  /**
   * `key`: it begins a run of messages that build on each other, as a video's frames do. `follows`: it can be used only
   * after all those before it in the run. `alone`: any other message.
   */
  link: 'alone' | 'key' | 'follows';
}

export interface BacklogLimits {
  bytes: number;
  messages: number;
}

/**
 * What waits for a client that reads slowly. If it becomes too much, the channel with the most bytes loses its oldest
 * message, so that clouds go before commands. A video that has lost a frame goes on with its next key frame.
 */
export class ClientBacklog {
  /** Messages that the client did not get because it reads too slowly. */
  dropped = 0;
  /** Called when a channel can go on with a key message only. */
  onKeyNeeded: ((channel: number) => void) | null = null;
  readonly #limits: BacklogLimits;
  readonly #bytesOf = new Map<number, number>();
  /** Channels that wait for a key message. */
  readonly #broken = new Set<number>();
  #waiting: LiveMessage[] = [];
  #bytes = 0;

  constructor(limits: BacklogLimits) {
    this.#limits = limits;
  }

  get bytes(): number {
    return this.#bytes;
  }

  get messages(): number {
    return this.#waiting.length;
  }

  /** From now on, the channel begins with a key message if it has any. */
  begin(channel: number): void {
    this.#broken.add(channel);
  }

  /** A single message may be larger than the limit. */
  push(message: LiveMessage): void {
    const { channel, link, bytes } = message;
    if (link !== 'follows') this.#broken.delete(channel);
    else if (this.#broken.has(channel)) {
      this.onKeyNeeded?.(channel);
      return;
    }
    this.#waiting.push(message);
    this.#add(channel, bytes.length);
    while (this.#isTooMuch()) this.#dropOldestOf(this.#largest());
  }

  /** Takes the message that is sent next. */
  next(): LiveMessage | null {
    const message = this.#waiting.shift();
    if (message === undefined) return null;
    this.#add(message.channel, -message.bytes.length);
    return message;
  }

  /** The client does not want this channel any more. */
  forget(channel: number): void {
    this.#waiting = this.#waiting.filter((each) => each.channel !== channel);
    this.#bytes -= this.#bytesOf.get(channel) ?? 0;
    this.#bytesOf.delete(channel);
    this.#broken.delete(channel);
  }

  #isTooMuch(): boolean {
    const { length } = this.#waiting;
    return length > 1 && (length > this.#limits.messages || this.#bytes > this.#limits.bytes);
  }

  #largest(): number {
    let largest = { channel: -1, bytes: -1 };
    for (const [channel, bytes] of this.#bytesOf) if (bytes > largest.bytes) largest = { channel, bytes };
    return largest.channel;
  }

  /** Drops a channel's oldest message, and what builds on it. */
  #dropOldestOf(channel: number): void {
    let state: 'before' | 'in' | 'after' = 'before';
    let isRun = false;
    const kept: LiveMessage[] = [];
    for (const message of this.#waiting) {
      if (message.channel === channel && state === 'in' && message.link !== 'follows') state = 'after';
      if (message.channel !== channel || state === 'after') {
        kept.push(message);
        continue;
      }
      state = 'in';
      isRun = message.link !== 'alone';
      this.dropped++;
      this.#add(channel, -message.bytes.length);
    }
    this.#waiting = kept;
    if (isRun && state === 'in') {
      this.#broken.add(channel);
      this.onKeyNeeded?.(channel);
    }
  }

  #add(channel: number, bytes: number): void {
    this.#bytes += bytes;
    const next = (this.#bytesOf.get(channel) ?? 0) + bytes;
    if (next === 0) this.#bytesOf.delete(channel);
    else this.#bytesOf.set(channel, next);
  }
}
