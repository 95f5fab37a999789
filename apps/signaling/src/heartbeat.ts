/** Something that is alive as long as it answers. */
export interface Pulse {
  /** Heard from since the last beat? */
  alive: boolean;
  ping(): void;
  dead(): void;
}

const SLOTS = 20;

/**
 * Pings every member once an interval and gives up those that have not been heard of since: a half-open socket goes
 * within two intervals. Members are spread over the interval: thousands of pings at once would hold up relays.
 */
export class Heartbeat {
  readonly #slots: Set<Pulse>[] = Array.from({ length: SLOTS }, () => new Set());
  readonly #timer: NodeJS.Timeout;
  #next = 0;
  #tick = 0;

  constructor(intervalMs: number) {
    this.#timer = setInterval(() => this.beat(), intervalMs / SLOTS);
    this.#timer.unref();
  }

  /** @returns removes it */
  add(member: Pulse): () => void {
    const slot = this.#slots[this.#next++ % SLOTS]!;
    slot.add(member);
    return () => slot.delete(member);
  }

  /** Does one slot. */
  beat(): void {
    for (const member of this.#slots[this.#tick++ % SLOTS]!) {
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
