/**
 * Turns the reference system's plain twists into commands, which the robot's guard then judges like any others. The
 * reference protocol has no lease, dead-man grip, sequence number or send time. This class supplies substitutes, and
 * errs on the side of standing still.
 */

import {
  type Command,
  isZeroTwist,
  nextSequence32,
  stampUsOf,
  type Twist,
  zeroTwist,
} from '@farpoint/protocol';
import type { CommandVerdict, DriveGuard } from '@farpoint/safety';
import { TokenBucket } from '@farpoint/timing';

/**
 * After this long without a request for motion, the lease is released, because nobody can ask for it, and
 * the grip counts as open. Not every reference operator sends a zero. Chosen: docs/safety.md says it.
 */
const LEASE_AFTER_MOTION_MS = 2000;
/**
 * Messages that arrive this close together were not sent so close together: they waited in a queue. Chosen,
 * ms: shorter than a display frame at 240 a second.
 */
const BURST_SPACING_MS = 4;
/** Each test costs a frame that is green. Chosen: more than anybody can press. */
const LATENCY_TESTS_PER_SECOND = 10;
/**
 * Its page does not say what it shows. Assumed from the robot's sending a cloud to the arrival of a command
 * that saw it. Chosen: its published round trip of 42.4 ms, drawing and a command's interval
 * (docs/reference-systems.md).
 */
const ASSUMED_LOOP_MS = 100;

export type ReferenceVerdict =
  /** The guard's verdict. */
  | CommandVerdict
  | 'latency-test' // make the next frame green
  | 'too-many-tests'
  | 'ignored'; // a zero of one who does not drive

export class ReferenceDriver {
  /** Commands that arrived in a burst from a queue. Each was treated as a stop. */
  bursts = 0;
  /** When the newest cloud that was sent to the operator was captured, ms; `null` before the first. */
  sentCaptureMs: number | null = null;
  readonly #id: string;
  readonly #guard: DriveGuard;
  readonly #tests = new TokenBucket({ perSecond: LATENCY_TESTS_PER_SECOND, burst: LATENCY_TESTS_PER_SECOND });
  #sequence = 0;
  #lastMs = Number.NEGATIVE_INFINITY;
  #afterGap = false;
  #lastMotionMs = Number.NEGATIVE_INFINITY;
  #mayHold: (() => boolean) | null;
  /** Whether its latest message asked for motion. */
  #asksMotion = false;
  /** Since when the path has lived and no motion was asked for, ms; `null` if it does not or was. */
  #quietSinceMs: number | null = null;

  /**
   * @param id the operator's id for the guard
   * @param mayHold asked once, at the first message: whether the hand may have held on since a session before. If not, it
   *   counts as open at first: not every reference operator can say so
   */
  constructor(id: string, guard: DriveGuard, mayHold: () => boolean = () => false) {
    this.#id = id;
    this.#guard = guard;
    this.#mayHold = mayHold;
  }

  /** Whether its hand may still hold on: it asked for motion, and has not let go since. */
  holds(nowMs: number): boolean {
    const isQuiet = this.#quietSinceMs !== null && nowMs - this.#quietSinceMs >= LEASE_AFTER_MOTION_MS;
    return this.#asksMotion && !isQuiet;
  }

  get holdsLease(): boolean {
    return this.#guard.leaseHolder === this.#id;
  }

  onTwist(twist: Twist, nowMs: number): ReferenceVerdict {
    if (this.#mayHold?.() === false) this.#guard.onOpenHand(this.#id);
    this.#mayHold = null;
    const { leaseHolder } = this.#guard;
    if (twist.linear.z !== 0) {
      const mayAsk = leaseHolder === null || leaseHolder === this.#id;
      return mayAsk && this.#tests.take(nowMs) ? 'latency-test' : 'too-many-tests';
    }
    const stood = this.#stoodInQueue(nowMs);
    const motion = !stood && !isZeroTwist(twist);
    if (!stood) this.#asksMotion = motion;
    if (motion && leaseHolder === null) this.#guard.requestLease(this.#id, false, nowMs);
    else if (!motion && leaseHolder !== this.#id) {
      if (!stood) this.#guard.onOpenHand(this.#id);
      return 'ignored';
    }
    if (motion) {
      this.#lastMotionMs = nowMs;
      this.#quietSinceMs = null;
    }
    const command = this.#toCommand(stood ? zeroTwist() : twist, nowMs);
    // What stood in a queue stops the robot, but does not say that the hand is open.
    return this.#guard.onCommand(this.#id, stood ? { ...command, unread: true } : command, nowMs);
  }

  /**
   * Releases the lease, and takes the hand as open, after a time without motion. Call this regularly.
   *
   * @param pathLives whether anything was received from the operator lately, on any channel
   * @returns whether the lease was released
   */
  checkQuiet(nowMs: number, pathLives: boolean): boolean {
    this.#quietSinceMs = pathLives ? (this.#quietSinceMs ?? nowMs) : null;
    const isQuiet = this.#quietSinceMs !== null && nowMs - this.#quietSinceMs >= LEASE_AFTER_MOTION_MS;
    const isOver = this.holdsLease && nowMs - this.#lastMotionMs >= LEASE_AFTER_MOTION_MS;
    const released = isOver && this.#guard.releaseLease(this.#id);
    // Not every reference operator says that its hand is open. On a path that lives, one that asks for nothing has let go.
    if (isQuiet && !this.holdsLease) this.#guard.onOpenHand(this.#id);
    return released;
  }

  /**
   * The channel is reliable and ordered. After a stall, everything that was held back arrives at once, and does not
   * say how old it is. Messages count as such a queue if they follow a silence that stopped the robot, and follow
   * each other without a pause.
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

  /** What it is assumed to see. */
  #seen(capturedMs: number): { seenUs: number } {
    this.#guard.sentViews.sent(this.#id, capturedMs);
    return { seenUs: stampUsOf(capturedMs) };
  }

  #toCommand(twist: Twist, nowMs: number): Command {
    this.#sequence = nextSequence32(this.#sequence);
    const state = this.#guard.leaseState(this.#id);
    return {
      type: 'command',
      sequence: this.#sequence,
      timeMs: nowMs,
      // A handle that belongs to nobody, if this operator has no lease.
      lease: state.holder === 'you' && state.lease !== undefined ? state.lease : 'none',
      deadMan: !isZeroTwist(twist),
      ...(this.sentCaptureMs === null ? {} : this.#seen(this.sentCaptureMs - ASSUMED_LOOP_MS)),
      twist,
    };
  }
}
