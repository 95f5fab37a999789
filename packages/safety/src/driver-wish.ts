import { type GoalReason, isZeroTwist, type Twist, zeroTwist } from '@farpoint/protocol';
import type { GuidedDrive } from './guided/guided-drive.ts';
import { Watchdog } from './watchdog.ts';

/** The velocity that the driver wants now: by hand, or by holding a goal to which a navigator leads the robot. */
export class DriverWish {
  readonly guided: GuidedDrive | null;
  readonly #watchdog: Watchdog;
  #twist: Twist = zeroTwist();
  /** Whether something other than the driver's wish has stopped the robot. */
  #forced = false;
  /** Whether the goal moved the robot when it was last asked. */
  #isLed = false;

  constructor(watchdogMs: number, guided: GuidedDrive | null) {
    this.#watchdog = new Watchdog(watchdogMs);
    this.guided = guided;
  }

  /** A command. @param atMs since when it is the driver's wish */
  take(twist: Twist, atMs: number): void {
    this.#twist = copyTwist(twist);
    this.#forced = false;
    this.#watchdog.feed(atMs);
  }

  /** The driver's hand is on the stick: no goal leads the robot any more. */
  takeOver(): void {
    this.guided?.end('cancelled', 'stick');
    this.#isLed = false;
  }

  /** The driver holds on to a goal. @returns whether it is the present one */
  hold(operatorId: string, goal: number, atMs: number): boolean {
    // Whoever holds a goal does not drive by hand, whichever it is.
    this.#twist = zeroTwist();
    this.#watchdog.reset();
    if (this.guided?.hold(operatorId, goal, atMs) !== true) return false;
    this.#forced = false;
    return true;
  }

  /** As a copy. */
  at(nowMs: number): Twist {
    const led = this.guided?.velocityAt(nowMs) ?? null;
    // Whatever ends a goal under way stops the robot as hard as allowed.
    if (led === null && this.#isLed) this.#forced = true;
    this.#isLed = led !== null && !isZeroTwist(led);
    if (led !== null && isZeroTwist(this.#twist)) return led;
    return this.#watchdog.expired(nowMs) ? zeroTwist() : copyTwist(this.#twist);
  }

  /** Whether something other than the driver's wish makes it zero. */
  stopsUrgently(nowMs: number): boolean {
    return this.#forced || this.isOverdue(nowMs);
  }

  /** Whether the driver's hand asks for motion, but has not said so for too long. */
  isOverdue(nowMs: number): boolean {
    return !isZeroTwist(this.#twist) && this.#watchdog.expired(nowMs);
  }

  /** Whether it asked for motion when it was last heard or asked. */
  get isMoving(): boolean {
    return this.#isLed || !isZeroTwist(this.#twist);
  }

  /** When it becomes zero, or may, without any further call; `null` while it is. */
  get deadlineMs(): number | null {
    if (!isZeroTwist(this.#twist)) return this.#watchdog.deadlineMs;
    return this.#isLed ? (this.guided?.deadlineMs ?? null) : null;
  }

  /** Nothing that was wished until now counts any more. */
  halt(because: GoalReason): void {
    if (this.isMoving) this.#forced = true;
    this.#twist = zeroTwist();
    this.#watchdog.reset();
    this.#isLed = false;
    this.guided?.end('cancelled', because);
  }
}

function copyTwist({ linear, angular }: Twist): Twist {
  return { linear: { ...linear }, angular: { ...angular } };
}
