/**
 * Decides what is sent on the control channel, and when. While the dead-man grip is held, it sends commands at a fixed
 * rate. When the grip is released, it sends a few zero commands, since any of them may be lost, and then nothing. Time
 * is an argument.
 */
import {
  type Command,
  type DriveLimits,
  type GoalHold,
  nextSequence32,
  type Twist,
  zeroTwist,
} from '@farpoint/protocol';
import { type DriveWish, intoTwist, REST, toTwist } from './velocity-mapping.ts';

export const COMMANDS_PER_SECOND = 40;
/** Number of zero commands sent after the grip is released. */
export const STOP_REPEATS = 4;
/** Number of commands that show an open grip after {@link CommandStream.showOpen}: the robot may still be braking. */
const OPEN_REPEATS = COMMANDS_PER_SECOND;
/** Number of zero commands before motion after {@link CommandStream.restFirst}, since one may be lost. */
export const FIRST_RESTS = 2;

export class CommandStream {
  #limits: DriveLimits | null = null;
  #lease: string | null = null;
  #sequence = 0;
  #wish: DriveWish = { ...REST };
  #held = false;
  #readMs: number | null = null;
  readonly #asked: Twist = zeroTwist();
  #stopsLeft = 0;
  #restsLeft = 0;
  #nextMs = 0;

  /** A new session: the grip counts as released, and the counter restarts. */
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

  /**
   * Sets the state of the operator's hand. A change of the grip takes effect at the next {@link tick}, at any rate.
   *
   * @param readMs when the device was read, which becomes the commands' time; `null`: at the tick
   */
  set(held: boolean, wish: DriveWish, readMs: number | null = null): void {
    this.#readMs = readMs;
    this.#wish.forward = wish.forward;
    this.#wish.left = wish.left;
    if (held === this.#held) return;
    this.#held = held;
    this.#stopsLeft = held ? 0 : STOP_REPEATS;
    this.#nextMs = 0;
  }

  /** The next grip starts with zero commands: the robot may not have heard that the grip was released in between. */
  restFirst(): void {
    this.#restsLeft = FIRST_RESTS;
  }

  /** The robot must see an open grip: tells it so for a second, or until a grip is pressed. */
  showOpen(): void {
    this.#held = false;
    this.#stopsLeft = OPEN_REPEATS;
    this.#nextMs = 0;
  }

  /** The velocity that the hand asks for now, the same object each time; `null` while it drives nothing. */
  get asked(): Twist | null {
    if (!this.#held || this.#limits === null || this.#lease === null) return null;
    return intoTwist(this.#wish, this.#limits, this.#asked);
  }

  /** The command due now, if any. */
  tick(nowMs: number): Command | null {
    if (!this.active || nowMs < this.#nextMs) return null;
    if (this.#limits === null || this.#lease === null) {
      // Without the lease commands would be rejected, and the robot stops by itself.
      this.#stopsLeft = 0;
      return null;
    }
    this.#nextMs = nowMs + this.intervalMs;
    const command = this.#make(nowMs, this.#limits, this.#lease);
    if (!this.#held) this.#stopsLeft--;
    else if (this.#restsLeft > 0) this.#restsLeft--;
    return command;
  }

  /** The least time between two commands, ms. */
  get intervalMs(): number {
    // The robot limits commands per second; a fifth is left for other messages and jitter.
    const most = (this.#limits?.maxCommandsPerSecond ?? COMMANDS_PER_SECOND) * 0.8;
    // 2 ms less, so that a timer that fires slightly early still sends this command.
    return 1000 / Math.min(COMMANDS_PER_SECOND, most) - 2;
  }

  /** Makes the hold of a goal, which counts like a command. @returns `null` without a lease */
  hold(nowMs: number, goal: number): GoalHold | null {
    if (this.#lease === null) return null;
    this.#sequence = nextSequence32(this.#sequence);
    return { type: 'goalHold', goal, sequence: this.#sequence, timeMs: nowMs, lease: this.#lease };
  }

  /**
   * Makes an extra command, outside the fixed rate, that asks for a latency-test frame. It repeats the current wish.
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
      // The robot judges a command's age: repeating an old reading must not make it young.
      timeMs: this.#held && this.#readMs !== null ? Math.min(this.#readMs, nowMs) : nowMs,
      lease,
      deadMan: this.#held,
      twist: this.#held && this.#restsLeft === 0 ? toTwist(this.#wish, limits) : zeroTwist(),
    };
  }
}
