/**
 * Headset controllers, WebXR's `xr-standard` mapping: thumbstick axes 2 and 3, the trigger is button 0, squeeze button 1, the
 * thumbstick's press button 3, A/X button 4, B/Y button 5. The hand that squeezes drives.
 */

import type { DriveInput, DriveWish, PressedButtons } from '@farpoint/operator';
import { DEFAULT_STICK_RESPONSE, shapeAxis } from './dead-zone.ts';
import type { GamepadState } from './gamepad-input.ts';

const TRIGGER = 0;
const SQUEEZE = 1;
const STICK_PRESS = 3;
const AX_BUTTON = 4;
const BY_BUTTON = 5;

/** What is read of an XRInputSource. */
export interface XrController {
  handedness: string;
  gamepad?: GamepadState | null | undefined;
}

export class HeadsetInput implements DriveInput {
  readonly name = 'headset';
  readonly wish: DriveWish = { forward: 0, left: 0 };
  held = false;
  #hand: string | null = null;
  #estop = false;
  #latency = false;
  #stickPress = false;

  /** @returns buttons that went down since the last call, or are held */
  read(sources: Iterable<XrController>): PressedButtons {
    let driving: XrController | null = null;
    let estop = false;
    let latency = false;
    let stickPress = false;
    let trigger = false;
    for (const source of sources) {
      const buttons = source.gamepad?.buttons;
      if (buttons === undefined) continue;
      estop ||= buttons[BY_BUTTON]?.pressed === true;
      latency ||= buttons[AX_BUTTON]?.pressed === true;
      stickPress ||= buttons[STICK_PRESS]?.pressed === true;
      trigger ||= (buttons[TRIGGER]?.value ?? 0) > 0.5;
      if ((buttons[SQUEEZE]?.value ?? 0) <= 0.5) continue;
      if (driving === null || source.handedness === this.#hand) driving = source;
    }
    this.held = driving !== null;
    this.#hand = driving?.handedness ?? null;
    const axes = driving?.gamepad?.axes;
    // Unused axes are null on some runtimes; shapeAxis takes that as rest. Forward is −1, right is +1.
    this.wish.forward = -shapeAxis(axes?.[3], DEFAULT_STICK_RESPONSE) + 0;
    this.wish.left = -shapeAxis(axes?.[2], DEFAULT_STICK_RESPONSE) + 0;
    const pressed = {
      estop: estop && !this.#estop,
      latencyTest: latency && !this.#latency,
      // A stick is easily pressed while it is pushed.
      nextRobot: stickPress && !this.#stickPress && !this.held,
      // A fist clenched in fright holds both.
      releaseHeld: trigger && !this.held,
    };
    this.#estop = estop;
    this.#latency = latency;
    this.#stickPress = stickPress;
    return pressed;
  }

  release(): void {
    this.held = false;
    this.wish.forward = 0;
    this.wish.left = 0;
    this.#hand = null;
  }
}
