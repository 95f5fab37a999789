/** Reusable memory for messages that are kept beyond the call that delivered them. */

/** Maximum number of free buffers kept for reuse. */
const MOST_SPARE = 8;

export interface MessageSlot {
  /** The message; valid until the last user has released it. */
  readonly bytes: Uint8Array;
}

interface OwnSlot extends MessageSlot {
  room: Uint8Array;
  bytes: Uint8Array;
  users: number;
}

export class MessageSlots {
  readonly #spare: OwnSlot[] = [];

  /**
   * Copies a message; the caller is its first user.
   *
   * @param lead bytes to leave before it, for the alignment that its content needs
   */
  keep(message: Uint8Array, lead = 0): MessageSlot {
    const slot: OwnSlot = this.#spare.pop() ?? {
      room: new Uint8Array(0),
      bytes: new Uint8Array(0),
      users: 0,
    };
    const needed = message.length + lead;
    if (slot.room.length < needed) slot.room = new Uint8Array(Math.ceil(needed * 1.25));
    slot.room.set(message, lead);
    slot.bytes = slot.room.subarray(lead, needed);
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
