/** The dialog for keys and controllers, and the greatest speed beside the controls for driving. */
import { effect, type ReadonlySignal } from '@preact/signals-core';
import { controllerKey } from '../drive/input-choices.ts';
import { controllerName } from '../status/input-words.ts';
import { ControllerControls } from './controller-controls.ts';
import { elements } from './elements.ts';
import { KeyControls } from './key-controls.ts';
import { followKeys, followKeyTitles, keepKeyTitles } from './key-hints.ts';
import { openDialog } from './open-dialog.ts';
import type { OperatorInputs } from './operator-inputs.ts';
import { speedControls } from './speed-controls.ts';

/** How often controllers are read while the dialog is open, ms. */
const READ_MS = 50;

export interface InputsDialogParts {
  readonly inputs: Pick<OperatorInputs, 'settings' | 'releaseAll'>;
  /** The most that the robot ever drives, m/s; 0 while it is not known. */
  readonly maxLinear: ReadonlySignal<number>;
  /** Whether this operator watches only. */
  readonly watches: ReadonlySignal<boolean>;
}

export class InputsDialog {
  readonly #parts: InputsDialogParts;
  readonly #keys: KeyControls;
  readonly #controllers = new Map<string, ControllerControls>();

  constructor(parts: InputsDialogParts) {
    this.#parts = parts;
    const { settings } = parts.inputs;
    this.#keys = new KeyControls(elements.inputsKeys, settings, say);
  }

  start(): void {
    const { inputs, maxLinear, watches } = this.#parts;
    const { inputs: dialog, inputsOpen, inputsSpeed, speedChoice } = elements;
    speedChoice.append(...speedControls(inputs.settings.speed, maxLinear));
    effect(() => {
      speedChoice.hidden = watches.value;
    });
    const title = document.createElement('h3');
    title.textContent = 'Greatest speed';
    inputsSpeed.append(title, ...speedControls(inputs.settings.speed, maxLinear));
    effect(() => followKeys(elements.drive, inputs.settings.keys.value));
    for (const part of [elements.bar, elements.drive])
      effect(() => followKeyTitles(part, inputs.settings.keys.value));
    keepKeyTitles(elements.pictures, inputs.settings.keys);
    inputsOpen.addEventListener('click', () => this.#open());
    // Escape leaves a key that was to be chosen, not the dialog.
    dialog.addEventListener('cancel', (event) => {
      if (this.#keys.isWaiting) event.preventDefault();
    });
    dialog.addEventListener('close', () => this.#keys.cancel());
  }

  #open(): void {
    const { inputs: dialog } = elements;
    this.#parts.inputs.releaseAll();
    say('');
    openDialog(dialog);
    this.#read();
    const timer = setInterval(() => this.#read(), READ_MS);
    dialog.addEventListener('close', () => clearInterval(timer), { once: true });
  }

  #read(): void {
    const { settings } = this.#parts.inputs;
    const pads = (navigator.getGamepads?.() ?? []).filter(isThere);
    const there = new Map(pads.map((pad) => [controllerKey(pad), pad]));
    const { inputsControllers } = elements;
    for (const [key, controls] of this.#controllers) {
      if (there.has(key)) continue;
      controls.dispose();
      controls.element.remove();
      this.#controllers.delete(key);
    }
    for (const [key, pad] of there) {
      let controls = this.#controllers.get(key);
      if (controls === undefined) {
        controls = new ControllerControls(key, controllerName(pad.id), settings, say);
        this.#controllers.set(key, controls);
        inputsControllers.append(controls.element);
      }
      controls.tick(pad);
    }
    inputsControllers.dataset.none = String(there.size === 0);
  }
}

function isThere(pad: Gamepad | null): pad is Gamepad {
  return pad !== null && pad.connected !== false;
}

function say(text: string): void {
  elements.inputsSaid.textContent = text;
}
