/** Something that must answer to count as alive. */
export interface Pulse {
  /** Whether it has been heard from since the last beat. */
  alive: boolean;
  ping(): void;
  dead(): void;
}

/** Parts of the interval. Chosen: of a thousand members, 50 are pinged at once. */
const SLOTS = 20;

/**
 * Pings every member once per interval, and gives up those that have not answered since: a half-open socket is
 * removed within two intervals. Members are spread over the interval, because thousands of pings at once would delay
 * relaying.
 */
export class Heartbeat {
  readonly #slots: Set<Pulse>[] = Array.from({ length: SLOTS }, () => new Set());
  readonly #timer: NodeJS.Timeout;
  #next = 0;
  #beats = 0;

  constructor(intervalMs: number) {
    this.#timer = setInterval(() => this.beat(), intervalMs / SLOTS);
    this.#timer.unref();
  }

  /** @returns a function that removes the member */
  add(member: Pulse): () => void {
    const slot = this.#slots[this.#next++ % SLOTS]!;
    slot.add(member);
    return () => slot.delete(member);
  }

  /** Processes one slot. */
  beat(): void {
    for (const member of this.#slots[this.#beats++ % SLOTS]!) {
      if (!member.alive) {
        member.dead();
        continue;
      }
      member.alive = false;
      member.ping();
    }
  }

  stop(): void {
    clearInterval(this.#timer);
  }
}
