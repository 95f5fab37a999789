/** How often the same fault is told, ms; and how many are remembered. */
const AGAIN_MS = 10_000;
const MOST_FAULTS = 64;

/** Lets the same fault through now and then: a topic may have it in every message. */
export class FaultLimit {
  readonly #toldMs = new Map<string, number>();

  /** Whether to tell it. */
  admits(fault: string, nowMs: number): boolean {
    const before = this.#toldMs.get(fault);
    if (before !== undefined && nowMs - before < AGAIN_MS) return false;
    // The order of a map is that in which its keys came.
    this.#toldMs.delete(fault);
    this.#toldMs.set(fault, nowMs);
    const oldest = this.#toldMs.keys().next();
    if (this.#toldMs.size > MOST_FAULTS && !oldest.done) this.#toldMs.delete(oldest.value);
    return true;
  }
}
