/**
 * Decides what is sent on the control channel, and when. While the dead-man grip is held, it sends commands at a fixed
 * rate. When the grip is released, or is not read any more, it sends a few commands that say so, since any of them may be
 * lost, and then nothing. Time is an argument.
 */
import {
  type Command,
  type DriveLimits,
  NO_LEASE,
  nextSequence32,
  type Twist,
  zeroTwist,
} from '@farpoint/protocol';
import { type DriveWish, intoTwist, REST, toTwist } from './velocity-mapping.ts';

/** As often as a hand is read: six commands within the 150 ms of the robot's watchdog. */
export const COMMANDS_PER_SECOND = 40;
/**
 * Number of commands sent after the grip is released, or is not read any more. Several, since each may be
 * lost; without any, the robot's watchdog stops it.
 */
export const STOP_REPEATS = 4;
/**
 * Number of commands that show an open grip after {@link CommandStream.showOpen}: a second's. Chosen: the robot
 * may still be braking, and counts it only once it stands.
 */
const OPEN_REPEATS = COMMANDS_PER_SECOND;
/** Number of zero commands before motion after {@link CommandStream.restFirst}, since one may be lost. */
export const FIRST_RESTS = 2;

/** What is known of the hand that drives. */
export type Hand =
  | 'open' // no grip is held
  | 'held' // its grip is held
  | 'unread'; // its grip was held when it was last read, but that is too long ago to drive by

export class CommandStream {
  #limits: DriveLimits | null = null;
  #lease: string | null = null;
  #sequence = 0;
  #wish: DriveWish = { ...REST };
  #hand: Hand = 'open';
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
    this.#hand = 'open';
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
    return this.held || this.#stopsLeft > 0;
  }

  /** Whether a grip drives now. */
  get held(): boolean {
    return this.#hand === 'held';
  }

  /**
   * Sets the state of the operator's hand. A changed grip takes effect at the next {@link due}, at any rate.
   *
   * @param wish while it is held
   * @param readMs when the device was read, which becomes the commands' time; `null`: as it is made
   */
  set(hand: Hand, wish: DriveWish, readMs: number | null = null): void {
    this.#readMs = readMs;
    this.#wish.forward = wish.forward;
    this.#wish.left = wish.left;
    this.#wish.sideways = wish.sideways;
    if (hand === this.#hand) return;
    this.#hand = hand;
    this.#stopsLeft = hand === 'held' ? 0 : STOP_REPEATS;
    this.#nextMs = 0;
  }

  /** The next grip starts with zero commands: the robot may not have heard that the grip was released in between. */
  restFirst(): void {
    this.#restsLeft = FIRST_RESTS;
  }

  /** The robot must see an open grip: tells it so for a second, or until a grip is pressed. */
  showOpen(): void {
    this.#hand = 'open';
    this.#stopsLeft = OPEN_REPEATS;
    this.#nextMs = 0;
  }

  /** The velocity that the hand asks for now, the same object each time; `null` while it drives nothing. */
  get asked(): Twist | null {
    if (!this.held || this.#limits === null || this.#lease === null) return null;
    return intoTwist(this.#wish, this.#limits, this.#asked);
  }

  /** The command due now, if any. */
  due(nowMs: number): Command | null {
    if (!this.active || nowMs < this.#nextMs) return null;
    if (this.#limits === null || this.#lease === null) {
      // Without the lease commands would be rejected, and the robot stops by itself.
      this.#stopsLeft = 0;
      return null;
    }
    // The robot limits commands per second; a fifth is left for other messages and jitter.
    const perSecond = Math.min(COMMANDS_PER_SECOND, this.#limits.maxCommandsPerSecond * 0.8);
    // 2 ms less, so that a timer that fires slightly early still sends this command.
    this.#nextMs = nowMs + 1000 / perSecond - 2;
    const command = this.#make(nowMs, this.#limits, this.#lease);
    if (!this.held) this.#stopsLeft--;
    else if (this.#restsLeft > 0) this.#restsLeft--;
    return command;
  }

  /**
   * Says that the hand is open, to a robot that it does not drive yet. The robot lets no hand drive that is not known to have
   * been open before.
   *
   * @returns `null` before the robot has said its limits, and with the lease: then {@link due} says it
   */
  openHand(nowMs: number): Command | null {
    if (this.#limits === null || this.#lease !== null || this.#hand !== 'open') return null;
    return this.#make(nowMs, this.#limits, NO_LEASE);
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
      timeMs: this.held && this.#readMs !== null ? Math.min(this.#readMs, nowMs) : nowMs,
      lease,
      deadMan: this.#hand !== 'open',
      ...(this.#hand === 'unread' ? { unread: true } : {}),
      twist: this.held && this.#restsLeft === 0 ? toTwist(this.#wish, limits) : zeroTwist(),
    };
  }
}
