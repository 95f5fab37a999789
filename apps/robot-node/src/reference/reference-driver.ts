/**
 * From the reference system's bare twists to commands that the robot's guard judges like any other. The reference
 * protocol has no lease, no dead-man grip, no sequence number and no time of sending; what stands for them is made here,
 * always on the side of standing still.
 */

import { type Command, isZeroTwist, nextSequence32, type Twist, zeroTwist } from '@farpoint/protocol';
import type { CommandVerdict, DriveGuard } from '@farpoint/safety';
import { TokenBucket } from '@farpoint/timing';

/**
 * Without a wish for motion for so long the lease is given back, as nobody can ask for it, and the hand counts as open: not
 * every operator of this kind says zero.
 */
const LEASE_AFTER_MOTION_MS = 2000;
/** Two messages so close were not spoken so close: they stood in a queue. */
const BURST_SPACING_MS = 4;
const LATENCY_TESTS_PER_SECOND = 10;

export type ReferenceVerdict =
  /** The guard has judged. */
  | CommandVerdict
  | 'latency-test' // make the next frame green
  | 'too-many-tests'
  | 'ignored'; // a zero of one who does not drive

export class ReferenceDriver {
  /** Commands that came out of a queue all at once: each was taken for a stop. */
  bursts = 0;
  readonly #id: string;
  readonly #guard: DriveGuard;
  readonly #tests = new TokenBucket({ perSecond: LATENCY_TESTS_PER_SECOND, burst: LATENCY_TESTS_PER_SECOND });
  #sequence = 0;
  #lastMs = Number.NEGATIVE_INFINITY;
  #afterGap = false;
  #lastMotionMs = Number.NEGATIVE_INFINITY;
  /** Since then nothing at all was heard for a while: the hand may still hold. */
  #pathWasSilent = false;

  /** @param id its name towards the guard */
  constructor(id: string, guard: DriveGuard) {
    this.#id = id;
    this.#guard = guard;
  }

  get holdsLease(): boolean {
    return this.#guard.leaseHolder === this.#id;
  }

  onTwist(twist: Twist, nowMs: number): ReferenceVerdict {
    const { leaseHolder } = this.#guard;
    if (twist.linear.z !== 0) {
      const mayAsk = leaseHolder === null || leaseHolder === this.#id;
      return mayAsk && this.#tests.take(nowMs) ? 'latency-test' : 'too-many-tests';
    }
    const wish = this.#stoodInQueue(nowMs) ? zeroTwist() : twist;
    const motion = !isZeroTwist(wish);
    if (motion && leaseHolder === null) this.#guard.requestLease(this.#id, false, nowMs);
    else if (!motion && leaseHolder !== this.#id) return 'ignored';
    if (motion) {
      this.#lastMotionMs = nowMs;
      this.#pathWasSilent = false;
    }
    return this.#guard.onCommand(this.#id, this.#toCommand(wish, nowMs), nowMs);
  }

  /**
   * Every so often.
   *
   * @param pathLives something was heard of the operator lately, on whatever channel
   * @returns whether the lease was given back
   */
  tick(nowMs: number, pathLives: boolean): boolean {
    if (!pathLives) this.#pathWasSilent = true;
    if (!this.holdsLease || nowMs - this.#lastMotionMs < LEASE_AFTER_MOTION_MS) return false;
    return this.#pathWasSilent ? this.#guard.releaseLease(this.#id) : this.#guard.operatorGone(this.#id);
  }

  /**
   * The channel is reliable and ordered: after a stall all that was held back comes at once, without saying how old it is.
   * What follows a silence that has stopped the robot, and is followed itself without a pause, is such a queue.
   */
  #stoodInQueue(nowMs: number): boolean {
    const sinceMs = nowMs - this.#lastMs;
    this.#lastMs = nowMs;
    if (sinceMs >= BURST_SPACING_MS) {
      this.#afterGap = sinceMs > this.#guard.limits.watchdogMs;
      return false;
    }
    if (this.#afterGap) this.bursts++;
    return this.#afterGap;
  }

  #toCommand(twist: Twist, nowMs: number): Command {
    this.#sequence = nextSequence32(this.#sequence);
    const state = this.#guard.leaseState(this.#id);
    return {
      type: 'command',
      sequence: this.#sequence,
      timeMs: nowMs,
      // A handle that nobody holds, where this operator holds none.
      lease: state.holder === 'you' && state.lease !== undefined ? state.lease : 'none',
      deadMan: !isZeroTwist(twist),
      twist,
    };
  }
}
