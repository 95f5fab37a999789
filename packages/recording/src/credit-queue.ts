/**
 * A bounded queue in front of something slow. A limited number of items is in progress at a time; the others wait here.
 * If too many wait, the oldest is dropped.
 */
export class CreditQueue<T> {
  dropped = 0;
  /** Gets what is dropped, for example to reuse its memory. */
  onDrop: ((item: T) => void) | null = null;
  readonly #post: (item: T) => void;
  readonly #capacity: number;
  readonly #waiting: T[] = [];
  #credits: number;

  constructor(limits: { underWay: number; waiting: number }, post: (item: T) => void) {
    this.#credits = limits.underWay;
    this.#capacity = limits.waiting;
    this.#post = post;
  }

  push(item: T): void {
    if (this.#credits > 0) {
      this.#credits--;
      this.#post(item);
      return;
    }
    this.#waiting.push(item);
    if (this.#waiting.length > this.#capacity) this.dropOldest();
  }

  /** Call when an item in progress is finished. */
  done(): void {
    const next = this.#waiting.shift();
    if (next === undefined) this.#credits++;
    else this.#post(next);
  }

  /** @returns false if nothing waits */
  dropOldest(): boolean {
    const oldest = this.#waiting.shift();
    if (oldest === undefined) return false;
    this.dropped++;
    this.onDrop?.(oldest);
    return true;
  }

  /** Sends everything that waits, at the end. */
  drain(): void {
    for (const item of this.#waiting.splice(0)) this.#post(item);
  }
}
