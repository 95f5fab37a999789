/** Sends the robot to a place, and holds on to that for as long as the operator is there. Time is an argument. */
import {
  type GoalCancel,
  type GoalHold,
  type GoalOffer,
  type GoalPhase,
  type GoalReason,
  type GoalRequest,
  type GoalState,
  goalHasEnded,
  nextSequence32,
} from '@farpoint/protocol';
import type { Driver } from './driver.ts';

/** A place on the floor: the frame of the telemetry's pose, m. */
export interface GoalPlace {
  /** m. */
  x: number;
  /** m. */
  y: number;
  /** The direction in which the robot is to stand, rad, −π to π; left out for any. */
  yaw?: number | undefined;
}

/** Why a goal has ended: by the robot, or here. */
export type GoalEnd =
  | GoalReason
  | 'hidden' // the page is hidden or has lost the focus
  | 'link-lost' // the path to the robot is lost, or the session
  | 'other-drives' // somebody else holds the lease
  | 'no-answer'; // the robot does not answer

/** A goal, and what has become of it. */
export interface GoalStatus {
  /** Where the robot is to go. */
  readonly place: Readonly<GoalPlace>;
  /** `asked`: the robot has not answered yet. */
  readonly state: GoalPhase | 'asked';
  /** Why it was refused, cancelled or blocked; `null` otherwise. */
  readonly reason: GoalEnd | null;
}

export interface GoalPort {
  sendSession(message: GoalRequest | GoalCancel): void;
  sendHold(hold: GoalHold): void;
  onChange(status: GoalStatus | null): void;
}

/** Without the robot's answer for so long, a goal is given up, ms. */
const ANSWER_MS = 3000;

/**
 * A goal under way. It ends here at once when the operator drives by hand, looks elsewhere, or loses the lease or the path
 * to the robot; and the robot ends it by itself when the holds stop. {@link RobotClient} creates and calls it.
 */
export class GoalDrive {
  readonly #driver: Driver;
  readonly #port: GoalPort;
  #offer: GoalOffer | null = null;
  #status: GoalStatus | null = null;
  #id = 0;
  #sent = false;
  #askedMs = 0;
  #nextMs = 0;

  constructor(driver: Driver, port: GoalPort) {
    this.#driver = driver;
    this.#port = port;
  }

  /** What the robot says of the goals that it takes; `null` if it takes none. */
  get offer(): GoalOffer | null {
    return this.#offer;
  }

  /** The newest goal of this session; `null` before the first. */
  get status(): GoalStatus | null {
    return this.#status;
  }

  /** Whether the robot is to go somewhere now. */
  get active(): boolean {
    const state = this.#status?.state;
    return state !== undefined && (state === 'asked' || !goalHasEnded(state));
  }

  /** A session begins or ends. */
  reset(): void {
    this.#offer = null;
    this.end('cancelled', 'link-lost');
    this.#id = 0;
  }

  /** The robot said what goals it takes. */
  onOffer(offer: GoalOffer | null): void {
    this.#offer = offer;
    this.#become(null);
  }

  /**
   * Sends the robot there. Requests the lease if nobody drives.
   *
   * @param nowMs `performance.now()`
   * @returns false if it takes no goals, or the operator drives by hand
   */
  go(place: GoalPlace, nowMs: number): boolean {
    if (this.#offer === null || this.#driver.suspended || this.#driver.isGripped) return false;
    if (this.#driver.holder === 'other') {
      this.#become({ place, state: 'refused', reason: 'other-drives' });
      return false;
    }
    // Also before the lease is there: an answer to the goal before must not be taken for this one's.
    this.#id = nextSequence32(this.#id);
    [this.#sent, this.#askedMs, this.#nextMs] = [false, nowMs, 0];
    if (this.#driver.holder === 'nobody') this.#driver.requestLease(false);
    this.#become({ place, state: 'asked', reason: null });
    this.tick(nowMs);
    return true;
  }

  /** Takes the goal back. @param reason why, for the operator */
  cancel(reason: GoalEnd = 'asked'): void {
    if (!this.active) return;
    if (this.#sent) this.#port.sendSession({ type: 'goalCancel', id: this.#id });
    this.end('cancelled', reason);
  }

  /** It has ended, whoever ended it. */
  end(state: 'refused' | 'cancelled', reason: GoalEnd): void {
    if (this.active && this.#status !== null) this.#become({ place: this.#status.place, state, reason });
  }

  /** The robot said what has become of a goal. */
  onState({ id, state, reason }: GoalState): void {
    if (!this.active || !this.#sent || id !== this.#id || this.#status === null) return;
    this.#become({ place: this.#status.place, state, reason: reason ?? null });
  }

  /** Sends what is due. Call it at the commands' rate. @param nowMs `performance.now()` */
  tick(nowMs: number): void {
    if (!this.active || this.#status === null) return;
    const end = this.#endBy(nowMs);
    if (end !== null) {
      this.cancel(end);
      return;
    }
    const { stream } = this.#driver;
    const { lease } = stream;
    // It was asked for, and is not here yet.
    if (lease === null) return;
    if (!this.#sent) {
      this.#sent = true;
      const { x, y, yaw } = this.#status.place;
      const towards = yaw === undefined ? {} : { yaw };
      // The click's own time: a goal that has waited for long is not wanted any more.
      this.#port.sendSession({ type: 'goal', id: this.#id, timeMs: this.#askedMs, lease, x, y, ...towards });
    }
    if (nowMs < this.#nextMs) return;
    const hold = stream.hold(nowMs, this.#id);
    if (hold === null) return;
    this.#nextMs = nowMs + stream.intervalMs;
    this.#port.sendHold(hold);
  }

  /** What ends it now; `null`: nothing does. */
  #endBy(nowMs: number): GoalEnd | null {
    const { stream, suspended, holder, isGripped } = this.#driver;
    // Also by a hand whose grip does not count: whoever grips wants to drive, not to be driven.
    if (isGripped) return 'stick';
    if (suspended) return 'hidden';
    if (holder === 'other') return this.#sent ? 'lease-lost' : 'other-drives';
    if (this.#sent && stream.lease === null) return 'lease-lost';
    return this.#status?.state === 'asked' && nowMs - this.#askedMs >= ANSWER_MS ? 'no-answer' : null;
  }

  #become(status: GoalStatus | null): void {
    if (status === null && this.#status === null) return;
    this.#status = status;
    this.#port.onChange(status);
  }
}
