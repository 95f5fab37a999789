/** A gamepad in the standard mapping: either stick, while a shoulder button is held. */

import type { DriveInput, DriveWish, PressedButtons } from '@farpoint/operator';
import { DEFAULT_STICK_RESPONSE, shapeAxis } from './dead-zone.ts';

/** Shoulder buttons and triggers in the standard mapping. */
const GRIP_BUTTONS = [4, 5, 6, 7];
const ESTOP_BUTTON = 1;
const LATENCY_BUTTON = 0;
const RELEASE_BUTTON = 3;
const NEXT_ROBOT_BUTTON = 9;

/** The fields of a Gamepad that are read. */
export interface GamepadState {
  axes: readonly (number | null)[];
  buttons: readonly { pressed: boolean; value: number }[];
}

export class GamepadInput implements DriveInput {
  readonly name = 'gamepad';
  readonly wish: DriveWish = { forward: 0, left: 0 };
  held = false;
  readMs = Number.NEGATIVE_INFINITY;
  #mustOpen = false;
  #estop = false;
  #latency = false;
  #next = false;

  /**
   * @param pad the gamepad's current state, or `null` if it is disconnected
   * @param nowMs `performance.now()`
   * @returns the buttons that were pressed since the last call, or are held
   */
  read(pad: GamepadState | null, nowMs: number): PressedButtons {
    this.readMs = nowMs;
    const estop = pad?.buttons[ESTOP_BUTTON]?.pressed === true;
    const latency = pad?.buttons[LATENCY_BUTTON]?.pressed === true;
    const next = pad?.buttons[NEXT_ROBOT_BUTTON]?.pressed === true;
    const pressed = {
      estop: estop && !this.#estop,
      latencyTest: latency && !this.#latency,
      nextRobot: next && !this.#next,
      releaseHeld: pad?.buttons[RELEASE_BUTTON]?.pressed === true,
    };
    this.#estop = estop;
    this.#latency = latency;
    this.#next = next;
    const grips = pad !== null && GRIP_BUTTONS.some((index) => (pad.buttons[index]?.value ?? 0) > 0.5);
    this.#mustOpen &&= grips;
    this.held = grips && !this.#mustOpen;
    const [x, y] = pad === null ? [0, 0] : strongerStick(pad.axes);
    this.wish.forward = -shapeAxis(y, DEFAULT_STICK_RESPONSE) + 0;
    this.wish.left = -shapeAxis(x, DEFAULT_STICK_RESPONSE) + 0;
    return pressed;
  }

  /** The hand counts as open until a reading has found it open. */
  release(): void {
    this.#mustOpen = true;
    this.held = false;
    this.wish.forward = 0;
    this.wish.left = 0;
  }
}

function strongerStick(axes: GamepadState['axes']): [number, number] {
  const [lx, ly, rx, ry] = [axes[0] ?? 0, axes[1] ?? 0, axes[2] ?? 0, axes[3] ?? 0];
  return Math.hypot(rx, ry) > Math.hypot(lx, ly) ? [rx, ry] : [lx, ly];
}
