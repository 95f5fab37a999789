/** One gamepad, wheel or joystick in the dialog for inputs: what it reads now, whether it drives, and its setup. */
import { effect, signal } from '@preact/signals-core';
import { type ControllerMap, missingOf } from '../../take/drive/controller-map.ts';
import { GamepadInput, type GamepadState } from '../../take/drive/gamepad-input.ts';
import { isStandardKey } from '../../take/drive/input-choices.ts';
import type { InputSettings } from '../../take/drive/input-settings.ts';
import { buttonName, missingWords } from '../../words/inputs-dialog-words.ts';
import { laterTexts } from '../../words/language.ts';
import { fixed } from '../../words/numbers.ts';
import { rowOf } from '../ui/panel-parts.ts';
import { DeviceSetup } from './device-setup.ts';
import { dialogButton, headingOf, keepingFocus, paragraphOf } from './dialog-parts.ts';

export interface DeviceParts {
  /** Of the device, as the browser remembers it. */
  readonly key: string;
  /** That people read. */
  readonly name: string;
  readonly settings: InputSettings;
  /** Tells what has come of a change. */
  say(text: string): void;
}

export class DeviceControls {
  readonly element = document.createElement('div');
  readonly #parts: DeviceParts;
  readonly #live = paragraphOf('', 'live');
  readonly #state = paragraphOf('');
  readonly #body = document.createElement('div');
  /** What the device would do; `null` while it is not being set up. */
  readonly #draft = signal<ControllerMap | null>(null);
  readonly #setup: DeviceSetup;
  /** Reads the device as it would drive. */
  readonly #probe = new GamepadInput();
  readonly #stop: () => void;

  constructor(parts: DeviceParts) {
    this.#parts = parts;
    const { key, name, settings, say } = parts;
    this.#live.ariaHidden = 'true';
    this.element.className = 'device';
    this.#setup = new DeviceSetup({
      key,
      say,
      draft: this.#draft,
      goesSideways: () => settings.goesSideways.value,
    });
    this.element.append(headingOf(name), this.#state, this.#live, this.#body);
    this.#stop = effect(() => {
      const draft = this.#draft.value;
      const map = draft ?? settings.mapOf(key);
      this.#showState(map, draft !== null);
      keepingFocus(this.#body, () => {
        this.#body.replaceChildren(...(draft === null ? this.#closed() : this.#opened(draft)));
      });
    });
  }

  dispose(): void {
    this.#stop();
  }

  /** Call this often. @param pad its state now @param nowMs `performance.now()` */
  tick(pad: GamepadState, nowMs: number): void {
    this.#showLive(pad, nowMs);
    this.#setup.tick(pad);
  }

  #showState(map: ControllerMap, isSettingUp: boolean): void {
    const { drives, notSetUp } = laterTexts().inputsDialog;
    const missing = isSettingUp ? missingWords(map) : missingOf(map) === null ? null : notSetUp;
    this.#state.textContent = missing ?? (isSettingUp ? '' : drives);
    this.#state.dataset.tone = missing === null ? 'good' : 'warning';
    this.#state.hidden = this.#state.textContent === '';
  }

  #showLive(pad: GamepadState, nowMs: number): void {
    const { key, settings } = this.#parts;
    const { live, gripHeld, gripOpen, axis } = laterTexts().inputsDialog;
    this.#probe.read(pad, nowMs, this.#draft.peek() ?? settings.mapOf(key));
    const { wish, held } = this.#probe;
    const read = pad.axes.map((value, i) => `${axis(i + 1)} ${fixed(value ?? 0, 2)}`);
    const down = pad.buttons.flatMap(({ pressed }, i) =>
      pressed ? [buttonName(i, isStandardKey(key))] : [],
    );
    const drive = live(fixed(wish.forward, 2), fixed(wish.left, 2));
    this.#live.textContent = [
      `${drive}, ${held ? gripHeld : gripOpen}`,
      read.join(' · '),
      down.join(' · ') || '–',
    ].join('\n');
  }

  #closed(): HTMLElement[] {
    const { key, name, settings, say } = this.#parts;
    const { setUp, setUpOf, resetDevice, resetDeviceOf, deviceReset } = laterTexts().inputsDialog;
    const open = dialogButton(setUp, setUpOf(name), () => {
      this.#draft.value = settings.mapOf(key);
    });
    const reset = dialogButton(resetDevice, resetDeviceOf(name), () => {
      settings.setController(key, null);
      say(deviceReset(name));
    });
    reset.hidden = !settings.controllers.value.has(key);
    return [rowOf('', open, reset)];
  }

  #opened(draft: ControllerMap): HTMLElement[] {
    const { key, name, settings, say } = this.#parts;
    const { save, cancel, unchanged, deviceSaved } = laterTexts().inputsDialog;
    const done = (text: string) => {
      this.#setup.cancel();
      this.#draft.value = null;
      this.element.querySelector('button')?.focus();
      say(text);
    };
    const keep = dialogButton(save, `${save}: ${name}`, () => {
      settings.setController(key, draft);
      done(deviceSaved(name));
    });
    keep.disabled = missingOf(draft) !== null;
    const leave = dialogButton(cancel, `${cancel}: ${name}`, () => done(unchanged));
    return [...this.#setup.rows(draft), rowOf('', keep, leave)];
  }
}
