/** Every device the page listens to. What is held is let go when the page cannot hear it any more. */
import type { DriveInput, PressedButtons } from '../drive/drive-input.ts';
import { GamepadInput } from '../drive/gamepad-input.ts';
import { HeadsetInput, type XrController } from '../drive/headset-input.ts';
import { KeyboardInput } from '../drive/keyboard-input.ts';
import { TouchJoystick } from '../drive/touch-joystick.ts';
import { elements } from './elements.ts';

export type Action = 'estop' | 'latency-test' | 'recentre' | 'view' | 'next-robot';

const ACTION_KEYS: Readonly<Record<string, Action>> = {
  KeyX: 'estop',
  KeyL: 'latency-test',
  KeyC: 'recentre',
  KeyV: 'view',
  KeyN: 'next-robot',
};

export class OperatorInputs {
  readonly all: readonly DriveInput[];
  onAction: (action: Action, timeMs: number) => void = () => undefined;
  readonly #keyboard = new KeyboardInput();
  readonly #gamepad = new GamepadInput();
  readonly #headset = new HeadsetInput();
  readonly #touch: TouchJoystick;
  readonly #onChange: () => void;

  constructor(onChange: () => void) {
    this.#onChange = onChange;
    this.#touch = new TouchJoystick(elements.joystick, elements.knob, onChange);
    this.all = [this.#headset, this.#touch, this.#gamepad, this.#keyboard];
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
    this.#onChange();
  }

  /** Gamepads tell nothing by themselves. */
  poll(): void {
    const pads = navigator.getGamepads?.() ?? [];
    const pad = pads.find((candidate) => candidate?.mapping === 'standard') ?? null;
    this.#buttons(this.#gamepad.read(pad));
  }

  /** In VR, each display frame. */
  readHeadset(sources: Iterable<XrController>): void {
    const wasHeld = this.#headset.held;
    this.#buttons(this.#headset.read(sources));
    if (wasHeld !== this.#headset.held) this.#onChange();
  }

  #buttons(pressed: PressedButtons): void {
    if (pressed.estop) this.onAction('estop', performance.now());
    if (pressed.latencyTest) this.onAction('latency-test', performance.now());
    if (pressed.nextRobot) this.onAction('next-robot', performance.now());
  }

  #onKey(event: KeyboardEvent, down: boolean): void {
    const { target } = event;
    const elsewhere = target instanceof HTMLInputElement || elements.settings.open;
    const driving = !elements.drive.hidden && !elsewhere;
    // A key that goes up is let go, whatever has the focus by now.
    if (!down) {
      if (!this.#keyboard.key(event.code, false)) return;
      if (driving) event.preventDefault();
      this.#onChange();
      return;
    }
    if (elsewhere || event.ctrlKey || event.metaKey || event.altKey) return;
    const choosing = target instanceof HTMLSelectElement;
    if (choosing && event.code.startsWith('Arrow')) return;
    // Space on a focused button would press it; driving goes first once a robot is there.
    if (driving && this.#keyboard.key(event.code, true)) {
      event.preventDefault();
      if (!event.repeat) this.#onChange();
      return;
    }
    const action = ACTION_KEYS[event.code];
    if (action === undefined) return;
    // A letter would choose from the list as well.
    if (choosing) event.preventDefault();
    if (!event.repeat) this.onAction(action, event.timeStamp);
  }
}
