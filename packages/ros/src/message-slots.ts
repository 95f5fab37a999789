/** Memory for messages that are kept beyond the call that brought them, used again and again. */

/** More are not kept for later use. */
const MOST_SPARE = 8;

export interface MessageSlot {
  /** The message; good until the last user has released it. */
  readonly bytes: Uint8Array;
}

interface OwnSlot extends MessageSlot {
  room: Uint8Array;
  bytes: Uint8Array;
  users: number;
}

export class MessageSlots {
  readonly #spare: OwnSlot[] = [];

  /** Copies a message; the caller is its first user. */
  keep(message: Uint8Array): MessageSlot {
    const slot: OwnSlot = this.#spare.pop() ?? {
      room: new Uint8Array(0),
      bytes: new Uint8Array(0),
      users: 0,
    };
    if (slot.room.length < message.length) slot.room = new Uint8Array(Math.ceil(message.length * 1.25));
    slot.room.set(message);
    slot.bytes = slot.room.subarray(0, message.length);
    slot.users = 1;
    return slot;
  }

  retain(slot: MessageSlot): void {
    (slot as OwnSlot).users++;
  }

  release(slot: MessageSlot): void {
    const own = slot as OwnSlot;
    own.users--;
    if (own.users === 0 && this.#spare.length < MOST_SPARE) this.#spare.push(own);
  }
}
