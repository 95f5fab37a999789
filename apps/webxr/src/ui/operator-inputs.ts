/** Every input device of the page. Held inputs count as released when the page no longer receives their events. */
import type { DriveInput, PressedButtons } from '@farpoint/operator';
import { effect } from '@preact/signals-core';
import { GamepadInput, type PadButtons } from '../drive/gamepad-input.ts';
import { type HeadsetButtons, HeadsetInput, type Tracks, type XrController } from '../drive/headset-input.ts';
import { controllerKey } from '../drive/input-choices.ts';
import { InputSettings } from '../drive/input-settings.ts';
import { type KeyMap, type KeyRole, roleOf } from '../drive/key-map.ts';
import { KeyboardInput } from '../drive/keyboard-input.ts';
import type { ReleaseControl } from '../drive/release-hold.ts';
import { ScaledInput } from '../drive/speed-choice.ts';
import { loadInputs, storeInputs } from '../drive/stored-inputs.ts';
import { TouchJoystick } from '../drive/touch-joystick.ts';
import type { Hand } from '../headset/headset-settings.ts';
import type { TalkControl } from '../sound/talk-hold.ts';
import { controllerName, controllerNotices } from '../status/input-words.ts';
import { elements } from './elements.ts';
import { isDialogOpen } from './open-dialog.ts';
import { takesText } from './takes-text.ts';

export type Action =
  | 'estop'
  | 'latency-test'
  | 'recentre'
  | 'view'
  | 'from-above'
  | 'hazards'
  | 'enlarge'
  | 'dashboard'
  | 'predict'
  | 'swap'
  | 'go-to'
  | 'next-robot'
  | 'save-scene'
  | 'save-clip'
  | 'help'
  | 'faster'
  | 'slower';

/** The keys with these roles do something at once. */
const ACTIONS: ReadonlySet<string> = new Set<Action>([
  ...([
    'latency-test',
    'recentre',
    'view',
    'from-above',
    'hazards',
    'enlarge',
    'dashboard',
    'predict',
  ] as const),
  ...(['swap', 'go-to', 'next-robot', 'save-scene', 'save-clip', 'help', 'faster', 'slower'] as const),
]);
/** How many controllers are read. */
const PADS = 8;

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
  /** A controller came that nobody has set up, or one went. */
  tell(text: string): void;
}

export class OperatorInputs {
  readonly all: readonly DriveInput[];
  /** What keys and controllers do. */
  readonly settings = new InputSettings(loadInputs(), storeInputs);
  readonly #keyboard = new KeyboardInput();
  /** By their number in the browser. */
  readonly #pads = Array.from({ length: PADS }, () => new GamepadInput());
  readonly #headset: HeadsetInput;
  readonly #touch: TouchJoystick;
  readonly #port: InputPort;

  /** @param driveHand the hand that drives in the headset */
  constructor(port: InputPort, driveHand: Hand) {
    this.#port = port;
    this.#headset = new HeadsetInput(driveHand);
    this.#touch = new TouchJoystick(elements.joystick, elements.knob, () => port.onChange());
    const { settings } = this;
    this.all = [this.#headset, this.#touch, ...this.#pads, this.#keyboard].map(
      (device) => new ScaledInput(device, settings.speed),
    );
    effect(() => this.#keyboard.setKeys(settings.keys.value, settings.oneHanded.value));
    window.addEventListener('gamepadconnected', ({ gamepad }) => {
      if (settings.isUnknown(controllerKey(gamepad)))
        port.tell(controllerNotices.unknown(controllerName(gamepad.id)));
    });
    window.addEventListener('gamepaddisconnected', ({ gamepad }) => {
      port.tell(controllerNotices.unplugged(controllerName(gamepad.id)));
    });
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
    for (const pad of this.#pads) pad.release();
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
    const pads = navigator.getGamepads?.() ?? [];
    // Whoever sets up a controller moves it.
    const settingUp = isDialogOpen();
    let releaseHeld = false;
    for (const [index, input] of this.#pads.entries()) {
      const pad = pads[index] ?? null;
      const isThere = pad !== null && pad.connected !== false;
      const map = isThere ? this.settings.mapOf(controllerKey(pad)) : undefined;
      const pressed = input.read(isThere ? pad : null, nowMs, map);
      if (settingUp) input.release();
      releaseHeld ||= pressed.releaseHeld && !settingUp;
      this.#buttons(pressed, settingUp);
    }
    this.#port.onRelease('gamepad', releaseHeld);
  }

  /** Whether the headset's grip is held. */
  get isHeadsetGripped(): boolean {
    return this.#headset.held;
  }

  /** Deflection to the right of the stick that turns the view in the headset, −1…1. */
  get turnStick(): number {
    return this.#headset.turnStick;
  }

  /** Deflection backwards of the stick that moves the menu's mark in the headset, −1…1. */
  get menuStick(): number {
    return this.#headset.menuStick;
  }

  /**
   * Call this before each display frame in VR.
   *
   * @param grabbing whether a hand holds something of the view @param inMenu whether the menu is open
   * @returns the buttons that were pressed; what the page itself knows has been done
   */
  readHeadset<Source extends XrController>(
    sources: Iterable<Source>,
    tracks: Tracks<Source>,
    grabbing: boolean,
    inMenu: boolean,
  ): HeadsetButtons {
    const wasHeld = this.#headset.held;
    const pressed = this.#headset.read(sources, performance.now(), tracks, grabbing, inMenu);
    this.#buttons(pressed, false);
    this.#port.onRelease('headset', pressed.releaseHeld);
    if (pressed.nextView) this.#port.onAction('view', performance.now());
    if (pressed.recentre) this.#port.onAction('recentre', performance.now());
    this.#port.onTalk('headset', this.#headset.talks);
    if (wasHeld !== this.#headset.held) this.#port.onChange();
    return pressed;
  }

  /** @param onlyStop whether the others do nothing now */
  #buttons(pressed: PressedButtons & Partial<PadButtons>, onlyStop: boolean): void {
    if (pressed.estop) this.#port.onAction('estop', performance.now());
    if (onlyStop) return;
    if (pressed.latencyTest) this.#port.onAction('latency-test', performance.now());
    if (pressed.nextRobot) this.#port.onAction('next-robot', performance.now());
    if (pressed.faster === true) this.#port.onAction('faster', performance.now());
    if (pressed.slower === true) this.#port.onAction('slower', performance.now());
  }

  #onKey(event: KeyboardEvent, down: boolean): void {
    const { target } = event;
    const role = roleOfKey(this.settings.keys.peek(), event);
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
    if (!typing && this.#onEstopKey(event, role)) return;
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
    // Where it has done something already, it is no key of the page.
    if (role === undefined || !isAction(role) || event.defaultPrevented) return;
    // A letter would also select an entry of the list.
    if (choosing) event.preventDefault();
    if (!event.repeat) this.#port.onAction(role, event.timeStamp);
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
    if (role === 'estop' || isSpaceOnControl) {
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

/** A question mark asks for help, wherever it is on the keyboard. */
function roleOfKey(keys: KeyMap, { code, key }: KeyboardEvent): KeyRole | undefined {
  return roleOf(keys, code) ?? (key === '?' ? 'help' : undefined);
}

function isPanelKey({ target, code }: KeyboardEvent): boolean {
  return target instanceof HTMLElement && target.dataset.panel !== undefined && code.startsWith('Arrow');
}

function isAction(role: KeyRole): role is KeyRole & Action {
  return ACTIONS.has(role);
}
