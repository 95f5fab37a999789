/**
 * Headset controllers in WebXR's `xr-standard` mapping: the thumbstick is axes 2 and 3, the trigger button 0, squeeze
 * button 1, the thumbstick's press button 3, A/X button 4 and B/Y button 5. One hand drives while it squeezes. The other
 * hand has the view. A bare hand, which has no grip that opens by itself, neither drives nor releases nor speaks.
 */

import type { DriveInput, DriveWish, PressedButtons } from '@farpoint/operator';
import type { Hand } from '../../ground/headset-settings.ts';
import { DEFAULT_STICK_RESPONSE, shapeAxis } from './dead-zone.ts';
import type { GamepadState } from './gamepad-input.ts';

const TRIGGER = 0;
const SQUEEZE = 1;
const STICK_PRESS = 3;
const AX_BUTTON = 4;
const BY_BUTTON = 5;

/** The fields of an XRInputSource that are read. */
export interface XrController {
  handedness: string;
  gamepad?: GamepadState | null | undefined;
  /** Present for a bare hand that the headset tracks. */
  hand?: unknown;
}

/** What an XR frame tells of a controller. */
export type Tracks<Source> = (source: Source) => boolean;

/** Buttons besides those that every device has. */
export interface HeadsetButtons extends PressedButtons {
  /** Pressed: shows the next view. */
  readonly nextView: boolean;
  /** Pressed: recentres. */
  readonly recentre: boolean;
}

export class HeadsetInput implements DriveInput {
  readonly name = 'headset';
  readonly wish: DriveWish = { forward: 0, left: 0 };
  held = false;
  /** Whether the operator speaks: one hand drives, and the other pulls its trigger. */
  talks = false;
  /** Deflection to the right of the other hand's stick, −1…1; 0 while that hand is not tracked. */
  turnStick = 0;
  readMs = Number.NEGATIVE_INFINITY;
  readonly #otherHand: Hand;
  #mustOpen = false;
  #hand: string | null = null;
  #estop = false;
  #latency = false;
  #nextRobot = false;
  #nextView = false;
  #recentre = false;

  /** @param driveHand the hand that drives. A controller that is of no hand drives, too. */
  constructor(driveHand: Hand = 'right') {
    this.#otherHand = driveHand === 'right' ? 'left' : 'right';
  }

  /**
   * @param sources the controllers in this XR frame
   * @param nowMs `performance.now()`
   * @param tracks whether the headset knows where it and this controller are. What an untracked controller reports may
   * be its last state from before it fell asleep, so this does not count as a reading of a hand that drives.
   * @param grabbing whether a hand holds something of the view. Nothing drives meanwhile, nor does a grip that was squeezed
   * meanwhile before it has been opened.
   * @returns the buttons that were pressed since the last call, or are held
   */
  read<Source extends XrController>(
    sources: Iterable<Source>,
    nowMs: number,
    tracks: Tracks<Source>,
    grabbing = false,
  ): HeadsetButtons {
    let driving: Source | null = null;
    let estop = false;
    let latency = false;
    let nextRobot = false;
    let nextView = false;
    let recentre = false;
    let trigger = false;
    this.turnStick = 0;
    for (const source of sources) {
      const buttons = buttonsOf(source);
      if (buttons === undefined) continue;
      estop ||= buttons[BY_BUTTON]?.pressed === true;
      trigger ||= (buttons[TRIGGER]?.value ?? 0) > 0.5;
      const isAx = buttons[AX_BUTTON]?.pressed === true;
      const isStickPressed = buttons[STICK_PRESS]?.pressed === true;
      if (source.handedness === this.#otherHand) {
        nextView ||= isAx;
        recentre ||= isStickPressed;
        const deflection = source.gamepad?.axes[2];
        // The last state of a controller that fell asleep would turn the view for ever.
        if (typeof deflection === 'number' && tracks(source)) this.turnStick = deflection;
        continue;
      }
      latency ||= isAx;
      nextRobot ||= isStickPressed;
      if ((buttons[SQUEEZE]?.value ?? 0) <= 0.5) continue;
      if (driving === null || source.handedness === this.#hand) driving = source;
    }
    this.#mustOpen = (this.#mustOpen || grabbing) && driving !== null;
    if (this.#mustOpen) driving = null;
    if (driving === null || tracks(driving)) this.readMs = nowMs;
    this.talks = driving !== null && pullsOther(sources, driving);
    this.held = driving !== null;
    this.#hand = driving?.handedness ?? null;
    const axes = driving?.gamepad?.axes;
    // Some runtimes report unused axes as null; shapeAxis treats these as centred. Forward is −1, right is +1.
    this.wish.forward = -shapeAxis(axes?.[3], DEFAULT_STICK_RESPONSE) + 0;
    this.wish.left = -shapeAxis(axes?.[2], DEFAULT_STICK_RESPONSE) + 0;
    const pressed = {
      estop: estop && !this.#estop,
      latencyTest: latency && !this.#latency,
      // Pushing a stick easily presses it too.
      nextRobot: nextRobot && !this.#nextRobot && !this.held,
      nextView: nextView && !this.#nextView,
      recentre: recentre && !this.#recentre,
      // A fist clenched in fright presses both the grip and the trigger.
      releaseHeld: trigger && !this.held,
    };
    this.#estop = estop;
    this.#latency = latency;
    this.#nextRobot = nextRobot;
    this.#nextView = nextView;
    this.#recentre = recentre;
    return pressed;
  }

  /** The hands count as open until a reading has found them open. */
  release(): void {
    this.#mustOpen = true;
    this.held = false;
    this.talks = false;
    this.wish.forward = 0;
    this.wish.left = 0;
    this.turnStick = 0;
    this.#hand = null;
  }
}

/** The buttons of a controller. The gamepad that some headsets give a bare hand is none. */
function buttonsOf({ gamepad, hand }: XrController): GamepadState['buttons'] | undefined {
  return hand == null ? gamepad?.buttons : undefined;
}

/** Whether the trigger of a hand other than the driving one is pulled. */
function pullsOther(sources: Iterable<XrController>, driving: XrController): boolean {
  for (const source of sources) {
    if (source !== driving && (buttonsOf(source)?.[TRIGGER]?.value ?? 0) > 0.5) return true;
  }
  return false;
}
