import { type HandshakeFragment, type HandshakeMessage, MAX_MESSAGE_BYTES } from './handshake-message.ts';

/** How far ahead of the next message fragments are kept: the longest flight has six messages. */
const MAX_AHEAD = 8;

interface Partial {
  type: number;
  body: Buffer;
  /** One flag per byte: fragments may overlap and arrive in any order. */
  come: Uint8Array;
  missing: number;
}

/** What happened to a fragment; `old`: its message was taken before. */
export type FragmentFate = 'kept' | 'old' | 'contradictory' | 'too-far-ahead';

/**
 * Assembles handshake messages from fragments that may be lost, duplicated or reordered, and returns them strictly in
 * the order of their numbers (RFC 6347 §4.2.2 and §4.2.3). Bounded in messages and bytes.
 */
export class HandshakeAssembler {
  #next = 0;
  readonly #partials = new Map<number, Partial>();

  /** Number of the message that is expected next. */
  get next(): number {
    return this.#next;
  }

  add({ type, length, messageSequence, offset, data }: HandshakeFragment): FragmentFate {
    if (messageSequence < this.#next) return 'old';
    if (messageSequence >= this.#next + MAX_AHEAD) return 'too-far-ahead';
    if (length > MAX_MESSAGE_BYTES || offset + data.length > length) return 'contradictory';
    let partial = this.#partials.get(messageSequence);
    if (partial === undefined) {
      partial = { type, body: Buffer.alloc(length), come: new Uint8Array(length), missing: length };
      this.#partials.set(messageSequence, partial);
    } else if (partial.type !== type || partial.body.length !== length) {
      return 'contradictory';
    }
    data.copy(partial.body, offset);
    for (let at = offset; at < offset + data.length; at++) {
      if (partial.come[at] === 0) {
        partial.come[at] = 1;
        partial.missing--;
      }
    }
    return 'kept';
  }

  /** The next message, once it is complete. It stays until {@link take} or {@link discard} is called. */
  peek(): HandshakeMessage | null {
    const partial = this.#partials.get(this.#next);
    if (partial === undefined || partial.missing > 0) return null;
    return { type: partial.type, messageSequence: this.#next, body: partial.body };
  }

  take(): void {
    this.#partials.delete(this.#next);
    this.#next++;
  }

  /** The message was not the peer's: another one with its number may come. */
  discard(): void {
    this.#partials.delete(this.#next);
  }
}
