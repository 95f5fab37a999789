/** One hand on one device: what every input device tells the driver. */
import type { DriveWish } from './velocity-mapping.ts';

/** A device that can drive the robot. It is read at every tick of the client. */
export interface DriveInput {
  /** What kind of device it is. */
  readonly name: 'keyboard' | 'gamepad' | 'touch' | 'headset' | 'script';
  /** The dead-man grip. */
  readonly held: boolean;
  /** Shaped: dead zone and curve applied. */
  readonly wish: Readonly<DriveWish>;
}

/** Buttons beside the grip: which went down since a device was last read, and which is held. */
export interface PressedButtons {
  /** Went down: latches the emergency stop. */
  readonly estop: boolean;
  /** Went down: starts a latency test. */
  readonly latencyTest: boolean;
  /** Went down: connects to the next robot of the list. */
  readonly nextRobot: boolean;
  /** Held now: the control that releases the emergency stop. */
  readonly releaseHeld: boolean;
}

/** The first device whose grip is held drives; the others are ignored until it lets go. */
export function activeInput(inputs: readonly DriveInput[], before: DriveInput | null): DriveInput | null {
  if (before?.held === true && inputs.includes(before)) return before;
  return inputs.find((input) => input.held) ?? null;
}
