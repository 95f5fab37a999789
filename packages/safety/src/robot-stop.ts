/** What a stop at the robot says. Only `go` lets the robot move. */
export type RobotStopState =
  | 'go'
  | 'pressed'
  | 'unheard' // it has said nothing yet
  | 'silent' // it has said nothing for too long
  | 'lost' // it cannot be read, or its other end is gone
  | 'settling'; // it says go again, but not for long enough

export interface RobotStopOptions {
  /** It must say something this often, ms; `null` if it speaks at changes only. */
  silentMs: number | null;
  /** How long it must say go, without a gap, before it counts: a contact that bounces releases nothing, ms. */
  steadyMs: number;
  /** Whether it was pressed when the robot last ran, and nobody has released it since. */
  pressed?: boolean;
}

/** Judges what one stop at the robot says. It stops at once; anything but a steady go stops. */
export class RobotStopSignal {
  readonly #options: RobotStopOptions;
  #stop: boolean | null;
  #heardMs = Number.NEGATIVE_INFINITY;
  /** Since when it has said go without a gap. */
  #goSinceMs: number | null = null;
  #lost = false;

  constructor(options: RobotStopOptions) {
    this.#options = options;
    this.#stop = options.pressed === true ? true : null;
    if (this.#stop !== null && options.silentMs !== null)
      throw new RangeError('what repeats itself is not remembered');
  }

  /** @param stop what it says @param atMs when it said so, on the robot's monotonic clock */
  hear(stop: boolean, atMs: number): void {
    const { silentMs } = this.#options;
    const gap = silentMs !== null && atMs - this.#heardMs > silentMs;
    if (stop) this.#goSinceMs = null;
    else if (gap || this.#lost || this.#stop !== false) this.#goSinceMs = atMs;
    this.#stop = stop;
    this.#lost = false;
    this.#heardMs = Math.max(this.#heardMs, atMs);
  }

  /** It cannot be read, until it is heard again. */
  lose(): void {
    this.#lost = true;
  }

  state(nowMs: number): RobotStopState {
    const { silentMs, steadyMs } = this.#options;
    if (this.#stop === true) return 'pressed';
    if (this.#lost) return 'lost';
    if (this.#stop === null) return 'unheard';
    if (silentMs !== null && nowMs - this.#heardMs > silentMs) return 'silent';
    return nowMs - (this.#goSinceMs ?? nowMs) < steadyMs ? 'settling' : 'go';
  }
}
