/** Messages that have arrived and were not read yet. Bounded: the oldest are dropped. */
const MOST = 10_000;

export class Inbox<T> {
  readonly #items: T[] = [];
  readonly #waiting = new Set<() => void>();

  push(item: T): void {
    this.#items.push(item);
    if (this.#items.length > MOST) this.#items.shift();
    for (const wake of this.#waiting) wake();
    this.#waiting.clear();
  }

  /** Discards what has arrived. */
  clear(): void {
    this.#items.length = 0;
  }

  /** Returns the next message that matches and discards earlier ones. @throws {Error} if none arrives in time */
  async next(
    is: (item: T) => boolean = () => true,
    timeoutMs = 10_000,
    what = 'what was waited for',
  ): Promise<T> {
    const deadline = performance.now() + timeoutMs;
    for (;;) {
      while (this.#items.length > 0) {
        const item = this.#items.shift() as T;
        if (is(item)) return item;
      }
      await this.#wait(deadline - performance.now(), what);
    }
  }

  async #wait(ms: number, what: string): Promise<void> {
    await new Promise<void>((resolve, reject) => {
      const wake = () => {
        clearTimeout(timer);
        resolve();
      };
      const timer = setTimeout(
        () => {
          this.#waiting.delete(wake);
          reject(new Error(`${what} did not come`));
        },
        Math.max(ms, 0),
      );
      this.#waiting.add(wake);
    });
  }
}
