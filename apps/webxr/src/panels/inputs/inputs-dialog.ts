/** The dialog for keys, gamepads, wheels and joysticks. It is built anew each time it is opened, and loaded when it first is. */
import type { ReadonlySignal } from '@preact/signals-core';
import { connectedPads } from '../../take/drive/connected-pads.ts';
import type { InputSettings } from '../../take/drive/input-settings.ts';
import { controllerName } from '../../words/input-words.ts';
import { laterTexts, texts } from '../../words/language.ts';
import { openDialog } from '../ui/open-dialog.ts';
import type { OperatorInputs } from '../ui/operator-inputs.ts';
import { DeviceControls } from './device-controls.ts';
import { dialogButton, headingOf, paragraphOf } from './dialog-parts.ts';
import { KeyControls } from './key-controls.ts';
import { speedControls } from './speed-controls.ts';

/** How often devices are read while the dialog is open, ms. Chosen: faster than a hand moves a stick to its end and back. */
const READ_MS = 50;

export interface InputsDialogParts {
  readonly inputs: Pick<OperatorInputs, 'pause'>;
  readonly settings: InputSettings;
  /** The most that the robot ever drives, m/s; 0 while it is not known. */
  readonly maxLinear: ReadonlySignal<number>;
}

export function openInputs(
  dialog: HTMLDialogElement,
  { inputs, settings, maxLinear }: InputsDialogParts,
): void {
  const words = laterTexts().inputsDialog;
  const title = headingOf(words.title, 'h2');
  Object.assign(title, { id: 'inputs-title', tabIndex: -1, autofocus: true });
  const said = paragraphOf('', 'said');
  said.role = 'status';
  const say = (text: string) => {
    said.textContent = text;
  };
  const keys = new KeyControls(settings, say);
  const devices = new Devices(settings, say);
  const speed = speedControls(settings.speed, maxLinear);
  const speedSection = document.createElement('section');
  speedSection.id = 'inputs-speed';
  speedSection.append(headingOf(texts().inputs.speedTitle), ...speed.elements);
  const menu = document.createElement('menu');
  menu.append(dialogButton(words.close, words.close, () => dialog.close()));
  const stands = paragraphOf(words.stands, 'hint small');
  dialog.replaceChildren(title, stands, said, speedSection, devices.element, keys.element, menu);
  const resume = inputs.pause();
  openDialog(dialog);
  devices.read();
  const timer = setInterval(() => devices.read(), READ_MS);
  dialog.addEventListener(
    'close',
    () => {
      clearInterval(timer);
      for (const part of [keys, devices, speed]) part.dispose();
      resume();
    },
    { once: true },
  );
}

/** Those that the browser shows now. */
class Devices {
  readonly element = document.createElement('section');
  readonly #settings: InputSettings;
  readonly #say: (text: string) => void;
  readonly #shown = new Map<string, DeviceControls>();
  readonly #none = paragraphOf(laterTexts().inputsDialog.noDevice, 'hint small');

  constructor(settings: InputSettings, say: (text: string) => void) {
    this.#settings = settings;
    this.#say = say;
    this.element.id = 'inputs-devices';
    this.element.append(headingOf(laterTexts().inputsDialog.devicesTitle), this.#none);
  }

  dispose(): void {
    for (const controls of this.#shown.values()) controls.dispose();
  }

  read(): void {
    const there = new Map(connectedPads().map(({ key, pad }) => [key, pad]));
    for (const [key, controls] of this.#shown) {
      if (there.has(key)) continue;
      controls.dispose();
      controls.element.remove();
      this.#shown.delete(key);
    }
    for (const [key, pad] of there) {
      let controls = this.#shown.get(key);
      if (controls === undefined) {
        const name = controllerName(pad.id);
        controls = new DeviceControls({ key, name, settings: this.#settings, say: this.#say });
        this.#shown.set(key, controls);
        this.element.append(controls.element);
      }
      controls.tick(pad, performance.now());
    }
    this.#none.hidden = there.size > 0;
  }
}
