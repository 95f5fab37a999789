/** The interface of input devices: each reports the state of one hand. */
import type { DriveWish } from './velocity-mapping.ts';

/** A device that can drive the robot. It is read at every tick of the client. */
export interface DriveInput {
  /** What kind of device it is. */
  readonly name: 'keyboard' | 'gamepad' | 'touch' | 'headset' | 'script';
  /** The dead-man grip. */
  readonly held: boolean;
  /** The wished motion, with dead zone and curve applied. */
  readonly wish: Readonly<DriveWish>;
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

/** The first device whose grip is held drives; the others are ignored until it is released. */
export function activeInput(inputs: readonly DriveInput[], before: DriveInput | null): DriveInput | null {
  if (before?.held === true && inputs.includes(before)) return before;
  return inputs.find((input) => input.held) ?? null;
}
