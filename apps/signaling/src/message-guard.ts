import { decodeJson, type JsonCodec, type MessageData, ProtocolError } from '@farpoint/protocol';
import { TokenBucket } from '@farpoint/timing';

export interface MessageLimits {
  /** Maximum size of an accepted message, bytes. */
  readonly maxMessageBytes: number;
  /** Rate limit of a socket's messages: sustained and burst. */
  readonly messagesPerSecond: number;
  readonly messageBurst: number;
  /** A socket is closed after this many refused messages. */
  readonly maxFaults: number;
}

export type Refusal = 'malformed' | 'too-large' | 'rate-limited';

/** Stands between a socket and its hub. Passes only messages of the protocol, and limits their rate. */
export class MessageGuard<T> {
  readonly #codec: JsonCodec<T>;
  readonly #maxFaults: number;
  readonly #binary: boolean;
  readonly #bucket: TokenBucket;
  readonly #refuse: (refusal: Refusal, detail: string) => void;
  #faults = 0;
  #limited = false;

  /**
   * @param refuse is called for each refused message, but only once for a run of rate-limited ones
   * @param options.binary JSON is also accepted in binary messages
   */
  constructor(
    codec: JsonCodec<T>,
    limits: MessageLimits,
    refuse: (refusal: Refusal, detail: string) => void,
    options: { binary?: boolean } = {},
  ) {
    this.#binary = options.binary ?? false;
    this.#codec = { ...codec, maxBytes: Math.min(codec.maxBytes, limits.maxMessageBytes) };
    this.#maxFaults = limits.maxFaults;
    this.#bucket = new TokenBucket({ perSecond: limits.messagesPerSecond, burst: limits.messageBurst });
    this.#refuse = refuse;
  }

  /** Whether there were so many faults that the socket should be closed. */
  get exhausted(): boolean {
    return this.#faults >= this.#maxFaults;
  }

  /** Counts a fault that the hub found in a well-formed message. */
  fault(): void {
    this.#faults++;
  }

  /** The message, or null if it was refused. */
  read(data: MessageData, nowMs: number): T | null {
    if (!this.#bucket.take(nowMs)) {
      this.#faults++;
      if (!this.#limited) this.#refuse('rate-limited', 'too many messages: slow down');
      this.#limited = true;
      return null;
    }
    this.#limited = false;
    if (typeof data !== 'string' && !this.#binary) {
      this.#faults++;
      this.#refuse('malformed', `${this.#codec.what}: must be text, not binary`);
      return null;
    }
    try {
      return decodeJson(this.#codec, data);
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error;
      this.#faults++;
      this.#refuse(error.code === 'too-large' ? 'too-large' : 'malformed', error.message);
      return null;
    }
  }
}
