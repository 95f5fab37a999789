/**
 * What is sent on the control channel, and when: while the dead-man grip is held a command at a fixed rate; when it is
 * let go a few zeros, since any one may be lost, and then nothing. Time is an argument.
 */
import { type Command, type DriveLimits, nextSequence32, zeroTwist } from '@farpoint/protocol';
import { type DriveWish, REST, toTwist } from './velocity-mapping.ts';

export const COMMANDS_PER_SECOND = 40;
/** Zeros sent after the grip is let go. */
export const STOP_REPEATS = 4;
/** Commands of rest before motion, where {@link CommandStream.restFirst} asks for it: one may be lost. */
export const FIRST_RESTS = 2;

export class CommandStream {
  #limits: DriveLimits | null = null;
  #lease: string | null = null;
  #sequence = 0;
  #wish: DriveWish = { ...REST };
  #held = false;
  #stopsLeft = 0;
  #restsLeft = 0;
  #nextMs = 0;

  /** A new session: nothing is held any more, the counter begins anew. */
  reset(): void {
    this.#limits = null;
    this.#lease = null;
    this.#sequence = 0;
    this.#stopsLeft = 0;
    this.#restsLeft = 0;
    this.#held = false;
  }

  setLimits(limits: DriveLimits): void {
    this.#limits = limits;
  }

  setLease(lease: string | null): void {
    this.#lease = lease;
  }

  get lease(): string | null {
    return this.#lease;
  }

  /** True while commands are due. */
  get active(): boolean {
    return this.#held || this.#stopsLeft > 0;
  }

  get held(): boolean {
    return this.#held;
  }

  /** The operator's hand now. A change of the grip is answered at the next {@link tick}, whatever the rate. */
  set(held: boolean, wish: DriveWish): void {
    this.#wish.forward = wish.forward;
    this.#wish.left = wish.left;
    if (held === this.#held) return;
    this.#held = held;
    this.#stopsLeft = held ? 0 : STOP_REPEATS;
    this.#nextMs = 0;
  }

  /** The next grip begins with rest: the robot may not have heard that the hand was open in between. */
  restFirst(): void {
    this.#restsLeft = FIRST_RESTS;
  }

  /** The command due now, if any. */
  tick(nowMs: number): Command | null {
    if (!this.active || nowMs < this.#nextMs) return null;
    if (this.#limits === null || this.#lease === null) {
      // Nobody to tell: what was moving has no lease and is stopped by the robot.
      this.#stopsLeft = 0;
      return null;
    }
    // The robot reads only so many a second; a fifth is left for other messages and jitter.
    const perSecond = Math.min(COMMANDS_PER_SECOND, this.#limits.maxCommandsPerSecond * 0.8);
    // 2 ms less: a timer that fires a little early is meant for this command.
    this.#nextMs = nowMs + 1000 / perSecond - 2;
    const command = this.#make(nowMs, this.#limits, this.#lease);
    if (!this.#held) this.#stopsLeft--;
    else if (this.#restsLeft > 0) this.#restsLeft--;
    return command;
  }

  /**
   * A command outside the rhythm that asks for a latency-test frame; it repeats the current wish.
   *
   * @returns `null` without a lease
   */
  latencyTest(nowMs: number, id: number): Command | null {
    if (this.#limits === null || this.#lease === null) return null;
    return { ...this.#make(nowMs, this.#limits, this.#lease), latencyTest: id };
  }

  #make(nowMs: number, limits: DriveLimits, lease: string): Command {
    this.#sequence = nextSequence32(this.#sequence);
    return {
      type: 'command',
      sequence: this.#sequence,
      timeMs: nowMs,
      lease,
      deadMan: this.#held,
      twist: this.#held && this.#restsLeft === 0 ? toTwist(this.#wish, limits) : zeroTwist(),
    };
  }
}
