// What these numbers give together with the others: see adaptive-rate-controller.ts.

/** How many feedback messages are examined: about 0.7 s. */
const MESSAGES = 10;
/** A floor exists if this many of them fall to within this margin of the least delay, ms. */
const AT_FLOOR = 4;
const FLOOR_MS = 0.7;

/** Detects that a delay falls to the same floor again and again: the propagation delay alone. */
export class SettledDelay {
  readonly #recent = new Float64Array(MESSAGES);
  readonly #sorted = new Float64Array(MESSAGES);
  #count = 0;

  /** @param delayMs of a message */
  add(delayMs: number): void {
    this.#recent[this.#count % MESSAGES] = delayMs;
    this.#count++;
  }

  reset(): void {
    this.#count = 0;
  }

  /** The floor, ms; NaN if there is none. */
  get value(): number {
    if (this.#count < MESSAGES) return Number.NaN;
    this.#sorted.set(this.#recent);
    this.#sorted.sort();
    const least = this.#sorted[0] as number;
    return (this.#sorted[AT_FLOOR - 1] as number) - least < FLOOR_MS ? least : Number.NaN;
  }
}
