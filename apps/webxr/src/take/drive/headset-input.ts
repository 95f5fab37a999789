/**
 * Headset controllers in WebXR's `xr-standard` mapping: the thumbstick is axes 2 and 3, the trigger button 0, squeeze
 * button 1, the thumbstick's press button 3, A/X button 4 and B/Y button 5. One hand drives while it squeezes. The other
 * hand has the view. A bare hand, which has no grip that opens by itself, neither drives nor releases nor speaks. While the
 * menu is open, the sticks of open hands and the triggers are the menu's; B and Y stop as ever, and the grip drives.
 */

import type { DriveInput, DriveWish, PressedButtons } from '@farpoint/operator';
import {
  DEFAULT_HEADSET,
  type Hand,
  type HeadsetSettings,
  otherHand,
} from '../../ground/headset-settings.ts';
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
  /** Pressed: opens or closes the menu. Never while a hand drives. */
  readonly menu: boolean;
}

/** Which buttons are held, on any controller that they belong to. */
interface HeldButtons {
  estop: boolean;
  menu: boolean;
  nextRobot: boolean;
  nextView: boolean;
  recentre: boolean;
  trigger: boolean;
}

/**
 * A stick that is deflected by more than this share is pushed. Chosen: a thumb that only lies on it, or presses it, moves it
 * less; drive.test.ts holds it.
 */
const PUSHED = 0.5;

const NOTHING_HELD: Readonly<HeldButtons> = {
  estop: false,
  menu: false,
  nextRobot: false,
  nextView: false,
  recentre: false,
  trigger: false,
};

export class HeadsetInput implements DriveInput {
  readonly name = 'headset';
  readonly wish: DriveWish = { forward: 0, left: 0 };
  held = false;
  /** Whether the stick of a hand that may drive is pushed, and its grip is open. */
  pushed = false;
  /** Whether the operator speaks: one hand drives, and the other pulls its trigger. */
  talks = false;
  /** Deflection to the right of the other hand's stick, −1…1; 0 while that hand is not tracked. */
  turnStick = 0;
  /** The grip of the hand that does not drive; `away` while that hand holds no controller that is tracked. */
  otherGrip: 'held' | 'open' | 'away' = 'away';
  /** Deflection backwards of the stick that is pushed most, −1…1, of hands that are tracked. */
  menuStick = 0;
  readMs = Number.NEGATIVE_INFINITY;
  readonly #settings: Pick<HeadsetSettings, 'driveHand'>;
  #driveHand: Hand;
  #mustOpen = false;
  #hand: string | null = null;
  #heldBefore: Readonly<HeldButtons> = NOTHING_HELD;
  /** Whether a trigger is pulled for the console. */
  triggerClaimed = false;
  /** A trigger that was pulled for the console releases nothing before it has been let go. */
  #triggerMustOpen = false;

  /** @param settings the hand that drives, as it is at each reading. A controller that is of no hand drives, too. */
  constructor(settings: Pick<HeadsetSettings, 'driveHand'> = DEFAULT_HEADSET) {
    this.#settings = settings;
    this.#driveHand = settings.driveHand;
  }

  /**
   * @param sources the controllers in this XR frame
   * @param nowMs `performance.now()`
   * @param tracks whether the headset knows where it and this controller are. What an untracked controller reports may
   * be its last state from before it fell asleep, so this does not count as a reading of a hand that drives.
   * @param grabbing whether a hand holds something of the view. Nothing drives meanwhile, nor does a grip that was squeezed
   * meanwhile before it has been opened.
   * @param inMenu whether the menu is open: then triggers release nothing, and sticks neither turn the view nor miss a grip
   * @returns the buttons that were pressed since the last call, or are held
   */
  read<Source extends XrController>(
    sources: Iterable<Source>,
    nowMs: number,
    tracks: Tracks<Source>,
    grabbing = false,
    inMenu = false,
  ): HeadsetButtons {
    const held = { ...NOTHING_HELD };
    this.turnStick = 0;
    this.otherGrip = 'away';
    this.menuStick = 0;
    const { driveHand } = this.#settings;
    // A grip that is held already was not meant to drive.
    if (driveHand !== this.#driveHand) this.release();
    this.#driveHand = driveHand;
    let driving = this.#readSources(sources, tracks, held);
    const isOpen = driving === null;
    this.#mustOpen = (this.#mustOpen || grabbing) && driving !== null;
    if (this.#mustOpen) driving = null;
    if (driving === null || tracks(driving)) this.readMs = nowMs;
    this.pushed = isOpen && !grabbing && !inMenu && this.#isAnyPushed(sources, tracks);
    if (inMenu) this.turnStick = 0;
    this.#triggerMustOpen = this.triggerClaimed || ((this.#triggerMustOpen || inMenu) && held.trigger);
    this.talks = driving !== null && pullsOther(sources, driving);
    this.held = driving !== null;
    this.#hand = driving?.handedness ?? null;
    const axes = driving?.gamepad?.axes;
    // Some runtimes report unused axes as null; shapeAxis treats these as centred. Forward is −1, right is +1.
    this.wish.forward = -shapeAxis(axes?.[3], DEFAULT_STICK_RESPONSE) + 0;
    this.wish.left = -shapeAxis(axes?.[2], DEFAULT_STICK_RESPONSE) + 0;
    return this.#pressedSince(held, inMenu);
  }

  /** The hand that does not drive. */
  get #otherHand(): Hand {
    return otherHand(this.#driveHand);
  }

  /** Notes which buttons are held, and the other hand's stick. @returns the controller that is squeezed to drive */
  #readSources<Source extends XrController>(
    sources: Iterable<Source>,
    tracks: Tracks<Source>,
    held: HeldButtons,
  ): Source | null {
    let driving: Source | null = null;
    for (const source of sources) {
      const buttons = buttonsOf(source);
      if (buttons === undefined) continue;
      held.estop ||= buttons[BY_BUTTON]?.pressed === true;
      held.trigger ||= (buttons[TRIGGER]?.value ?? 0) > 0.5;
      const isAx = buttons[AX_BUTTON]?.pressed === true;
      const isStickPressed = buttons[STICK_PRESS]?.pressed === true;
      this.#readMenuStick(source, tracks);
      if (source.handedness === this.#otherHand) {
        held.nextView ||= isAx;
        held.recentre ||= isStickPressed;
        // The last state of a controller that fell asleep would turn the view for ever.
        if (tracks(source)) this.#readOther(source, buttons);
        continue;
      }
      held.menu ||= isAx;
      held.nextRobot ||= isStickPressed;
      if ((buttons[SQUEEZE]?.value ?? 0) <= 0.5) continue;
      if (driving === null || source.handedness === this.#hand) driving = source;
    }
    return driving;
  }

  #readOther({ gamepad }: XrController, buttons: GamepadState['buttons']): void {
    const deflection = gamepad?.axes[2];
    if (typeof deflection === 'number') this.turnStick = deflection;
    this.otherGrip = (buttons[SQUEEZE]?.value ?? 0) > 0.5 ? 'held' : 'open';
  }

  #readMenuStick<Source extends XrController>(source: Source, tracks: Tracks<Source>): void {
    const backwards = source.gamepad?.axes[3];
    if (typeof backwards !== 'number' || Math.abs(backwards) <= Math.abs(this.menuStick)) return;
    if (tracks(source)) this.menuStick = backwards;
  }

  #isAnyPushed<Source extends XrController>(sources: Iterable<Source>, tracks: Tracks<Source>): boolean {
    for (const source of sources) {
      if (source.handedness === this.#otherHand || buttonsOf(source) === undefined) continue;
      const [, , x, y] = source.gamepad?.axes ?? [];
      if (Math.hypot(x ?? 0, y ?? 0) > PUSHED && tracks(source)) return true;
    }
    return false;
  }

  #pressedSince(held: HeldButtons, inMenu: boolean): HeadsetButtons {
    const before = this.#heldBefore;
    this.#heldBefore = held;
    return {
      estop: held.estop && !before.estop,
      // It is an entry of the menu.
      latencyTest: false,
      // Either hand closes it.
      menu: !this.held && ((held.menu && !before.menu) || (inMenu && held.nextView && !before.nextView)),
      // Pushing a stick easily presses it too.
      nextRobot: held.nextRobot && !before.nextRobot && !this.held && !inMenu,
      nextView: held.nextView && !before.nextView && !inMenu,
      recentre: held.recentre && !before.recentre && !inMenu,
      // A fist clenched in fright presses both the grip and the trigger.
      releaseHeld: held.trigger && !this.held && this.otherGrip !== 'held' && !this.#triggerMustOpen,
    };
  }

  /** The hands count as open until a reading has found them open. */
  release(): void {
    this.#mustOpen = true;
    this.held = false;
    this.pushed = false;
    this.talks = false;
    this.wish.forward = 0;
    this.wish.left = 0;
    this.turnStick = 0;
    this.otherGrip = 'away';
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
