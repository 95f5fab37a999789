import type { RobotState, RobotStatus } from '@farpoint/protocol';

/** What a robot says about itself to whoever looks at the list of robots. */
export const LIST_STATUSES = ['off', 'state', 'names'] as const;
export type ListStatus = (typeof LIST_STATUSES)[number];

/**
 * The least time between two statuses, ms. Chosen: a list is looked at by people who choose a robot, and a first change
 * after a pause is told at once. status-reporter.test.ts holds it.
 */
const BETWEEN_MS = 2000;
/**
 * Steps in which a battery is told, so that it is not told again all the time. Chosen: people read whole percent.
 * status-reporter.test.ts holds it.
 */
const BATTERY_STEPS = 100;

/** What the robot knows of itself. */
export interface OwnStatus extends Omit<RobotStatus, 'sinceMs'> {
  /** The session that has the lease; `null`: none. A driver's name may be another's, too. */
  readonly holder: string | null;
}

/** Decides when a robot's status is told: at each change, but not too often. Time is an argument. */
export class StatusReporter {
  readonly #names: boolean;
  #told: string | null = null;
  #toldMs = Number.NEGATIVE_INFINITY;
  #state: RobotState | null = null;
  #holder: string | null = null;
  #sinceMs = 0;

  /** @param names whether it tells who drives */
  constructor(names: boolean) {
    this.#names = names;
  }

  /** Nobody has heard it yet: the connection is a new one. */
  reset(): void {
    this.#told = null;
  }

  /**
   * @param nowMs monotonic
   * @param unixMs the time of day
   * @returns what is to be told now; `null`: nothing
   */
  next({ holder, battery, driver, ...status }: OwnStatus, nowMs: number, unixMs: number): RobotStatus | null {
    if (status.state !== this.#state || holder !== this.#holder)
      [this.#state, this.#holder, this.#sinceMs] = [status.state, holder, Math.max(0, Math.round(unixMs))];
    if (nowMs - this.#toldMs < BETWEEN_MS) return null;
    const told: RobotStatus = {
      ...status,
      sinceMs: this.#sinceMs,
      ...(battery === undefined ? {} : { battery: Math.round(battery * BATTERY_STEPS) / BATTERY_STEPS }),
      ...(driver === undefined || !this.#names ? {} : { driver }),
    };
    const text = JSON.stringify(told);
    if (text === this.#told) return null;
    [this.#told, this.#toldMs] = [text, nowMs];
    return told;
  }
}
