/** Every input device of the page. Held inputs count as released when the page no longer receives their events. */
import type { DriveInput, PressedButtons } from '@farpoint/operator';
import { effect } from '@preact/signals-core';
import type { HeadsetSettings } from '../../ground/headset-settings.ts';
import type { Notices } from '../../state/notices.ts';
import { Gamepads } from '../../take/drive/gamepads.ts';
import { HeadsetInput, type Tracks, type XrController } from '../../take/drive/headset-input.ts';
import {
  type Action,
  isAction,
  type KeyRole,
  pressedRole,
  STOP_KEY_ALWAYS,
} from '../../take/drive/key-map.ts';
import { KeyboardInput } from '../../take/drive/keyboard-input.ts';
import type { ReleaseControl } from '../../take/drive/release-hold.ts';
import { ScaledInput } from '../../take/drive/speed-choice.ts';
import { inputSettings } from '../../take/drive/stored-inputs.ts';
import { TouchJoystick } from '../../take/drive/touch-joystick.ts';
import { controllerName } from '../../words/input-words.ts';
import { texts } from '../../words/language.ts';
import { elements } from './elements.ts';
import { isDialogOpen } from './open-dialog.ts';
import { takesText } from './takes-text.ts';

export type TalkControl = 'key' | 'pointer' | 'headset';

/** Whether any of the controls with which an operator speaks is held. */
export class TalkHold {
  readonly #down = new Set<TalkControl>();

  /** @returns whether any is held now */
  set(control: TalkControl, down: boolean): boolean {
    if (down) this.#down.add(control);
    else this.#down.delete(control);
    return this.#down.size > 0;
  }
}

export interface InputPort {
  /** A grip or a stick changed. */
  onChange(): void;
  onAction(action: Action, timeMs: number): void;
  /** The release control of the emergency stop was pressed or let go. */
  onRelease(control: ReleaseControl, held: boolean): void;
  /** A control with which the operator speaks was pressed or let go. */
  onTalk(control: TalkControl, held: boolean): void;
  /** Whether there is a robot to drive. */
  mayDrive(): boolean;
}

export class OperatorInputs {
  readonly all: readonly DriveInput[];
  readonly #keyboard = new KeyboardInput();
  readonly #gamepads: Gamepads;
  readonly #headset: HeadsetInput;
  readonly #touch: TouchJoystick;
  readonly #port: InputPort;
  /** How many dialogs keep the devices from driving. */
  #pauses = 0;

  /** @param headset with the hand that drives in the headset, which may become the other one */
  constructor(port: InputPort, headset: Pick<HeadsetSettings, 'driveHand'>, notices: Pick<Notices, 'tell'>) {
    this.#port = port;
    this.#headset = new HeadsetInput(headset);
    this.#touch = new TouchJoystick(elements.joystick, elements.knob, () => port.onChange());
    this.#gamepads = new Gamepads(inputSettings, {
      onUnknown: (id) => notices.tell(texts().inputs.unknown(controllerName(id)), 'warning'),
      onUnplugged: (id) => notices.tell(texts().inputs.unplugged(controllerName(id)), 'warning'),
    });
    const devices = [this.#headset, this.#touch, ...this.#gamepads.all, this.#keyboard];
    this.all = devices.map((device) => new ScaledInput(device, inputSettings.speed));
    effect(() => this.#keyboard.setKeys(inputSettings.keys.value));
    effect(() => this.#keyboard.setSideways(inputSettings.goesSideways.value));
    window.addEventListener('keydown', (event) => this.#onKey(event, true));
    window.addEventListener('keyup', (event) => this.#onKey(event, false));
    window.addEventListener('blur', () => this.releaseAll());
    document.addEventListener('visibilitychange', () => {
      if (document.hidden) this.releaseAll();
    });
  }

  releaseAll(): void {
    this.#keyboard.releaseAll();
    this.#touch.release();
    this.#headset.release();
    this.#gamepads.release();
    for (const control of ['key', 'pointer', 'headset'] as const) {
      this.#port.onRelease(control, false);
      this.#port.onTalk(control, false);
    }
    this.#port.onChange();
  }

  /**
   * Polls the gamepads, which send no events. Keys and fingers that are down stay so while this is called: a page that
   * hangs does not hear that they were let go.
   */
  poll(nowMs: number): void {
    this.#keyboard.runs(nowMs);
    this.#touch.runs(nowMs);
    const pressed = this.#gamepads.read(navigator.getGamepads?.() ?? [], nowMs);
    // Browsers also let a page read it that has no focus, as beside another robot's: there it only stops.
    if (!document.hasFocus()) {
      if (pressed.estop) this.#port.onAction('estop', nowMs);
      return;
    }
    this.#buttons(pressed, 'gamepad');
    if (pressed.faster) this.#port.onAction('faster', nowMs);
    if (pressed.slower) this.#port.onAction('slower', nowMs);
  }

  /**
   * Keeps gamepads from driving, and releases every grip, until the returned function is called: their owner sets them up, or
   * tries what the help lists. Their buttons for STOP work. Afterwards a device drives only once its grip has been opened.
   *
   * @returns lets them drive again; only its first call counts
   */
  pause(): () => void {
    let isOver = false;
    this.#pauses++;
    this.#applyPauses();
    return () => {
      if (isOver) return;
      isOver = true;
      this.#pauses--;
      this.#applyPauses();
    };
  }

  #applyPauses(): void {
    this.#gamepads.settingUp = this.#pauses > 0;
    this.releaseAll();
  }

  /** Whether the headset's grip is held. */
  get isHeadsetGripped(): boolean {
    return this.#headset.held;
  }

  /** Deflection to the right of the stick that turns the view in the headset, −1…1. */
  get turnStick(): number {
    return this.#headset.turnStick;
  }

  /** The grip of the headset's hand that does not drive. */
  get otherGrip(): HeadsetInput['otherGrip'] {
    return this.#headset.otherGrip;
  }

  /** Deflection backwards of the stick that moves the headset's menu, −1…1. */
  get menuStick(): number {
    return this.#headset.menuStick;
  }

  /** A trigger of the headset is pulled for its console, or not any more: until it is let go it releases nothing. */
  claimTrigger(claimed: boolean): void {
    this.#headset.triggerClaimed = claimed;
  }

  /**
   * Call this before each display frame in VR.
   *
   * @param hands whether a hand holds something of the view, and whether the menu is open
   * @returns whether the button was pressed that opens or closes the menu
   */
  readHeadset<Source extends XrController>(
    sources: Iterable<Source>,
    tracks: Tracks<Source>,
    { grabbing, inMenu }: { grabbing: boolean; inMenu: boolean },
  ): boolean {
    const wasHeld = this.#headset.held;
    const pressed = this.#headset.read(sources, performance.now(), tracks, grabbing, inMenu);
    this.#buttons(pressed, 'headset');
    if (pressed.nextView) this.#port.onAction('view', performance.now());
    if (pressed.recentre) this.#port.onAction('recentre', performance.now());
    this.#port.onTalk('headset', this.#headset.talks);
    if (wasHeld !== this.#headset.held) this.#port.onChange();
    return pressed.menu;
  }

  #buttons(pressed: PressedButtons, control: ReleaseControl): void {
    if (pressed.estop) this.#port.onAction('estop', performance.now());
    this.#port.onRelease(control, pressed.releaseHeld);
    if (pressed.latencyTest) this.#port.onAction('latency-test', performance.now());
    if (pressed.nextRobot) this.#port.onAction('next-robot', performance.now());
  }

  #onKey(event: KeyboardEvent, down: boolean): void {
    const { target } = event;
    const role = pressedRole(inputSettings.keys.peek(), event.code, event.key);
    const typing = takesText(target);
    const elsewhere = typing || isDialogOpen();
    const driving = this.#port.mayDrive() && !elsewhere;
    // A released key counts as released wherever the focus is by now.
    if (!down) {
      if (role === 'release' || event.code === 'Enter') this.#port.onRelease('key', false);
      if (role === 'talk') this.#port.onTalk('key', false);
      if (!this.#keyboard.key(event.code, false, performance.now())) return;
      if (driving) event.preventDefault();
      this.#port.onChange();
      return;
    }
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if ((!typing || event.code === STOP_KEY_ALWAYS) && this.#onEstopKey(event, role)) return;
    if (role === 'help' && !typing) {
      this.#askHelp(event);
      return;
    }
    if (elsewhere) return;
    const choosing = target instanceof HTMLSelectElement || target instanceof HTMLInputElement;
    if (choosing && event.code.startsWith('Arrow')) return;
    // They move a panel that has the focus, unless somebody drives.
    if (isPanelKey(event) && !this.#keyboard.held) return;
    // Space would press a focused button. Driving takes precedence while there is a robot.
    if (driving && this.#keyboard.key(event.code, true, performance.now())) {
      event.preventDefault();
      if (!event.repeat) this.#port.onChange();
      return;
    }
    if (role === 'talk' && driving) {
      if (choosing) event.preventDefault();
      if (!event.repeat) this.#port.onTalk('key', true);
      return;
    }
    if (role === undefined || !isAction(role)) return;
    // A letter would also select an entry of the list.
    if (choosing) event.preventDefault();
    if (!event.repeat) this.#port.onAction(role, event.timeStamp);
  }

  /** The key that opens the help also closes it, whatever in it has the focus. */
  #askHelp(event: KeyboardEvent): void {
    // It would also search in the page.
    event.preventDefault();
    if (event.repeat) return;
    if (event.shiftKey && this.#keyboard.letGoOfShift(performance.now())) this.#port.onChange();
    this.#port.onAction('help', event.timeStamp);
  }

  /**
   * Handles the keys of the emergency stop, which take precedence over all others. @returns whether it was one of
   * them
   */
  #onEstopKey(event: KeyboardEvent, role: KeyRole | undefined): boolean {
    const { target, code } = event;
    const { estop, estopRelease } = elements;
    const isSpaceOnControl = code === 'Space' && (target === estop || target === estopRelease);
    const isRelease = role === 'release' || (code === 'Enter' && target === estopRelease);
    if (role === 'estop' || code === STOP_KEY_ALWAYS || isSpaceOnControl) {
      if (!event.repeat) this.#port.onAction('estop', event.timeStamp);
    } else if (isRelease && !isDialogOpen()) {
      // Key repeat is not a new press.
      if (!event.repeat) this.#port.onRelease('key', true);
    } else return false;
    // The key must not click the focused element or select from a list.
    event.preventDefault();
    return true;
  }
}

function isPanelKey({ target, code }: KeyboardEvent): boolean {
  return target instanceof HTMLElement && target.dataset.panel !== undefined && code.startsWith('Arrow');
}
