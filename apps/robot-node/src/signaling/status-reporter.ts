import type { RobotStatus } from '@farpoint/protocol';

/** What a robot says about itself to whoever looks at the list of robots. */
export const LIST_STATUSES = ['off', 'state', 'names'] as const;
export type ListStatus = (typeof LIST_STATUSES)[number];

/** The least time between two statuses, ms. */
export const BETWEEN_MS = 1000;
/** A battery is said in steps of this, so that it is not said again all the time. */
const BATTERY_STEP = 0.01;

/** Decides when a robot's status is said: at each change, but once a second at most. Time is an argument. */
export class StatusReporter {
  readonly #names: boolean;
  #said: string | null = null;
  #saidMs = Number.NEGATIVE_INFINITY;

  /** @param names whether it says who drives */
  constructor(names: boolean) {
    this.#names = names;
  }

  /** Nobody has heard it yet: the connection is a new one. */
  reset(): void {
    this.#said = null;
  }

  /** @returns what is to be said now; `null`: nothing */
  next(status: RobotStatus, nowMs: number): RobotStatus | null {
    if (nowMs - this.#saidMs < BETWEEN_MS) return null;
    const told = this.#told(status);
    const text = JSON.stringify(told);
    if (text === this.#said) return null;
    [this.#said, this.#saidMs] = [text, nowMs];
    return told;
  }

  #told({ battery, driver, ...status }: RobotStatus): RobotStatus {
    return {
      ...status,
      ...(battery === undefined ? {} : { battery: Math.round(battery / BATTERY_STEP) * BATTERY_STEP }),
      ...(driver === undefined || !this.#names ? {} : { driver }),
    };
  }
}
