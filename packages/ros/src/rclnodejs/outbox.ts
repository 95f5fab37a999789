/**
 * How many messages may be in transit to the robot: few, so that the newest waits here and not behind old ones. Chosen:
 * one is read while the next is on its way.
 */
const AT_ONCE = 2;

export class Outbox<T> {
  received = 0;
  dropped = 0;
  readonly #most: number;
  readonly #send: (message: T) => void;
  readonly #waiting: T[] = [];
  #underway = 0;

  /** @param most that may wait; beyond that, the oldest is dropped and counted */
  constructor(most: number, send: (message: T) => void) {
    this.#most = most;
    this.#send = send;
  }

  add(message: T): void {
    this.received++;
    this.#waiting.push(message);
    this.#sendOn();
    if (this.#waiting.length <= this.#most) return;
    this.#waiting.shift();
    this.dropped++;
  }

  /** Call when a message has arrived. */
  taken(): void {
    this.#underway = Math.max(0, this.#underway - 1);
    this.#sendOn();
  }

  #sendOn(): void {
    while (this.#underway < AT_ONCE) {
      const next = this.#waiting.shift();
      if (next === undefined) return;
      this.#underway++;
      this.#send(next);
    }
  }
}
