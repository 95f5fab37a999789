/** What the robot did while it was told something new: the measurements from which its model is fitted. Bounded memory. */

/** At 20 reports a second, 20 s of motion. */
const CAPACITY = 400;

/** Intervals between two reported poses, oldest first. Times are the robot's monotonic clock, ms. */
export class TravelWindow {
  readonly from = new Float64Array(CAPACITY);
  readonly to = new Float64Array(CAPACITY);
  /** Metres along the heading. */
  readonly travel = new Float64Array(CAPACITY);
  /** Radians. */
  readonly turn = new Float64Array(CAPACITY);
  #first = 0;
  #length = 0;
  #travelled = 0;
  #turned = 0;

  get length(): number {
    return this.#length;
  }

  /** Metres and radians in it: how much it can tell of each axis. */
  get travelled(): number {
    return this.#travelled;
  }

  get turned(): number {
    return this.#turned;
  }

  clear(): void {
    this.#first = 0;
    this.#length = 0;
    this.#travelled = 0;
    this.#turned = 0;
  }

  /** Place of an interval in the arrays. @param index from the oldest, 0 */
  at(index: number): number {
    return (this.#first + index) % CAPACITY;
  }

  add(fromMs: number, toMs: number, travel: number, turn: number): void {
    if (this.#length === CAPACITY) this.dropOldest();
    const at = this.at(this.#length++);
    this.from[at] = fromMs;
    this.to[at] = toMs;
    this.travel[at] = travel;
    this.turn[at] = turn;
    this.#travelled += Math.abs(travel);
    this.#turned += Math.abs(turn);
  }

  dropOldest(): void {
    if (this.#length === 0) return;
    this.#travelled -= Math.abs(this.travel[this.#first] as number);
    this.#turned -= Math.abs(this.turn[this.#first] as number);
    this.#first = (this.#first + 1) % CAPACITY;
    this.#length--;
  }
}
