/** The interface of input devices: each reports the state of one hand. */
import type { DriveWish } from './velocity-mapping.ts';

/** A device that can drive the robot. It is read at every {@link RobotClient.update}. */
export interface DriveInput {
  /** What kind of device it is. */
  readonly name: 'keyboard' | 'gamepad' | 'touch' | 'headset' | 'script';
  /** The dead-man grip. */
  readonly held: boolean;
  /** The wished motion, with dead zone and curve applied. */
  readonly wish: Readonly<DriveWish>;
  /** Whether the stick is pushed although the grip is open; left out: whether the wish is not zero. */
  readonly pushed?: boolean;
  /**
   * When the state above was last known to be the hand's, ms (`performance.now()`): when the device was polled, or, for
   * a device that reports by events, when the page last ran. A grip whose device is not read for 100 ms moves nothing
   * until it is read again, and counts as released if that takes longer than the robot allows. `null` only for an input
   * that lets go by itself when nobody renews it.
   */
  readonly readMs: number | null;
}

/** Buttons besides the grip: those pressed since the device was last read, and one that is held. */
export interface PressedButtons {
  /** Pressed: latches the emergency stop. */
  readonly estop: boolean;
  /** Pressed: starts a latency test. */
  readonly latencyTest: boolean;
  /** Pressed: connects to the next robot of the list. */
  readonly nextRobot: boolean;
  /** Held now: the button that releases the emergency stop. */
  readonly releaseHeld: boolean;
}

/**
 * The first device whose grip is held drives; the others are ignored until it is released.
 *
 * @param holds whether a device's grip counts as held
 */
export function activeInput(
  inputs: readonly DriveInput[],
  before: DriveInput | null,
  holds: (input: DriveInput) => boolean = isHeld,
): DriveInput | null {
  if (before !== null && holds(before) && inputs.includes(before)) return before;
  return inputs.find(holds) ?? null;
}

function isHeld({ held }: DriveInput): boolean {
  return held;
}
