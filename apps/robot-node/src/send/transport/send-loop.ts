/** What `SendLoop` drives. */
export interface Pumped {
  pump(): void;
  readonly nextDueMs: number | null;
}

/** One timer for all operators' senders. It sleeps while nobody has anything to send. */
export class SendLoop {
  readonly #senders = new Set<Pumped>();
  /** Called with the processor time of each round, ms. */
  onWork: ((ms: number) => void) | null = null;
  readonly #now: () => number;
  readonly #cpu: () => number;
  #timer: NodeJS.Timeout | null = null;

  /** @param cpu processor time of this thread, ms */
  constructor(now: () => number, cpu: () => number = () => 0) {
    this.#now = now;
    this.#cpu = cpu;
  }

  add(sender: Pumped): void {
    this.#senders.add(sender);
  }

  remove(sender: Pumped): void {
    this.#senders.delete(sender);
  }

  /** Sends what is due, and sleeps until the next packet is due. Call this after a frame was enqueued. */
  run(): void {
    if (this.#timer !== null) clearTimeout(this.#timer);
    this.#timer = null;
    if (this.#nextDueMs <= this.#now()) {
      const began = this.#cpu();
      for (const sender of this.#senders) sender.pump();
      this.onWork?.(this.#cpu() - began);
    }
    const next = this.#nextDueMs;
    if (next === Number.POSITIVE_INFINITY) return;
    this.#timer = setTimeout(() => this.run(), Math.max(1, Math.ceil(next - this.#now())));
  }

  get #nextDueMs(): number {
    let next = Number.POSITIVE_INFINITY;
    for (const sender of this.#senders) next = Math.min(next, sender.nextDueMs ?? Number.POSITIVE_INFINITY);
    return next;
  }

  close(): void {
    if (this.#timer !== null) clearTimeout(this.#timer);
    this.#timer = null;
    this.#senders.clear();
  }
}
