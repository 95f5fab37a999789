/**
 * A bounded queue before something slow. So many items are under way at a time; the others wait here, and where too many
 * wait the oldest is dropped.
 */
export class CreditQueue<T> {
  dropped = 0;
  /** Gets what is dropped, e.g. to use its memory again. */
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

  /** One that was under way has arrived. */
  done(): void {
    const next = this.#waiting.shift();
    if (next === undefined) this.#credits++;
    else this.#post(next);
  }

  /** @returns false where nothing waits */
  dropOldest(): boolean {
    const oldest = this.#waiting.shift();
    if (oldest === undefined) return false;
    this.dropped++;
    this.onDrop?.(oldest);
    return true;
  }

  /** Lets go of everything that waits, at the end. */
  drain(): void {
    for (const item of this.#waiting.splice(0)) this.#post(item);
  }
}
