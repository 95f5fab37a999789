/** What a queue stores about a packet. */
export interface QueuedPacket {
  /** When it joined the queue, or when it is due. */
  timeMs: number;
  bytes: number;
  /** Who sent it: see link-model.ts. */
  owner: number;
  /** The owner's handle for it. */
  handle: number;
  /** How long it waited at the bottleneck. */
  queueMs: number;
}

/** First in, first out, in typed arrays that double when full: nothing is allocated per packet. */
export class PacketRing {
  #times = new Float64Array(64);
  #waits = new Float64Array(64);
  #bytes = new Int32Array(64);
  #owners = new Int32Array(64);
  #handles = new Int32Array(64);
  #head = 0;
  #length = 0;

  get length(): number {
    return this.#length;
  }

  push(timeMs: number, bytes: number, owner: number, handle: number, queueMs: number): void {
    if (this.#length === this.#times.length) this.#grow();
    const at = (this.#head + this.#length++) & (this.#times.length - 1);
    this.#times[at] = timeMs;
    this.#waits[at] = queueMs;
    this.#bytes[at] = bytes;
    this.#owners[at] = owner;
    this.#handles[at] = handle;
  }

  /** The oldest packet's time; Infinity if there is none. */
  get headMs(): number {
    return this.#length === 0 ? Number.POSITIVE_INFINITY : this.#times[this.#head]!;
  }

  /** The oldest packet's size; 0 if there is none. */
  get headBytes(): number {
    return this.#length === 0 ? 0 : this.#bytes[this.#head]!;
  }

  /** Removes the oldest packet; the ring must not be empty. */
  shift(out: QueuedPacket): void {
    const at = this.#head;
    out.timeMs = this.#times[at]!;
    out.queueMs = this.#waits[at]!;
    out.bytes = this.#bytes[at]!;
    out.owner = this.#owners[at]!;
    out.handle = this.#handles[at]!;
    this.#head = (at + 1) & (this.#times.length - 1);
    this.#length--;
  }

  #grow(): void {
    const order = <T extends Float64Array | Int32Array>(from: T, to: T): T => {
      const tail = from.subarray(this.#head);
      to.set(tail);
      to.set(from.subarray(0, this.#head), tail.length);
      return to;
    };
    const size = this.#times.length * 2;
    this.#times = order(this.#times, new Float64Array(size));
    this.#waits = order(this.#waits, new Float64Array(size));
    this.#bytes = order(this.#bytes, new Int32Array(size));
    this.#owners = order(this.#owners, new Int32Array(size));
    this.#handles = order(this.#handles, new Int32Array(size));
    this.#head = 0;
  }
}
