/** The rows in which a device is set up: each role's axis or buttons, learned from what the hand moves. */
import type { Signal } from '@preact/signals-core';
import { type AxisMap, DEAD_ZONES } from '../../take/drive/axis-map.ts';
import { Calibration, MovedAxis, PressedButton } from '../../take/drive/controller-learning.ts';
import {
  AXIS_ROLES,
  type AxisRole,
  assignAxis,
  assignButton,
  assignGripAxis,
  BUTTON_ROLES,
  type ButtonRole,
  type ControllerMap,
  type MapChange,
  removeButton,
} from '../../take/drive/controller-map.ts';
import type { GamepadState } from '../../take/drive/gamepad-input.ts';
import { isStandardKey } from '../../take/drive/input-choices.ts';
import { buttonName, capital, mapRefusalWords, measuredWords } from '../../words/inputs-dialog-words.ts';
import { laterTexts } from '../../words/language.ts';
import { rowOf, sliderOf } from '../ui/panel-parts.ts';
import { checkOf, dialogButton } from './dialog-parts.ts';

/** What the hand is asked to do. */
type Task =
  | { readonly kind: 'axis'; readonly stick: number; readonly role: AxisRole; readonly moved: MovedAxis }
  | { readonly kind: 'grip'; readonly moved: MovedAxis; readonly pressed: PressedButton }
  | { readonly kind: 'button'; readonly role: ButtonRole; readonly pressed: PressedButton }
  | { readonly kind: 'range'; readonly run: Calibration };

/** The slider's step for a dead zone. Chosen: finer is not felt. */
const DEAD_ZONE_STEP = 0.02;

export interface DeviceSetupParts {
  readonly key: string;
  readonly draft: Signal<ControllerMap | null>;
  /** Whether the robot can go sideways. */
  goesSideways(): boolean;
  /** Tells what the hand is to do, and what has come of it. */
  say(text: string): void;
}

export class DeviceSetup {
  readonly #parts: DeviceSetupParts;
  #pad: GamepadState = { axes: [], buttons: [] };
  #task: Task | null = null;

  constructor(parts: DeviceSetupParts) {
    this.#parts = parts;
  }

  /** Leaves what the hand was asked to do. */
  cancel(): void {
    this.#task = null;
  }

  /** Call this often. @param pad its state now */
  tick(pad: GamepadState): void {
    this.#pad = pad;
    const task = this.#task;
    if (task === null) return;
    if (task.kind === 'range') {
      task.run.see(pad.axes);
      return;
    }
    const button = task.kind === 'axis' ? null : task.pressed.see(pad.buttons);
    if (button !== null) {
      const role = task.kind === 'grip' ? 'grip' : (task as { role: ButtonRole }).role;
      this.#apply(this.#nameOf(button), (map) => assignButton(map, role, button));
      return;
    }
    const axis = task.kind === 'button' ? null : task.moved.see(pad.axes);
    if (axis === null) return;
    this.#apply(laterTexts().inputsDialog.axis(axis.axis + 1), (map) =>
      task.kind === 'axis' ? assignAxis(map, task.stick, task.role, axis) : assignGripAxis(map, axis),
    );
  }

  rows(map: ControllerMap): HTMLElement[] {
    const axes = map.sticks.flatMap((stick, index) =>
      this.#axisRoles().flatMap((role) =>
        this.#axisRows(role, index, map.sticks.length, stick[role] ?? null),
      ),
    );
    const buttons = BUTTON_ROLES.flatMap((role) => this.#buttonRows(role, map));
    return [...axes, ...buttons, rowOf('', this.#measure())];
  }

  /** Those that the robot can follow. */
  #axisRoles(): readonly AxisRole[] {
    return AXIS_ROLES.filter((role) => role !== 'sideways' || this.#parts.goesSideways());
  }

  #axisRows(role: AxisRole, stick: number, sticks: number, axis: AxisMap | null): HTMLElement[] {
    const { axisRoles, axisPrompts, setAxis, set, stick: stickWords } = laterTexts().inputsDialog;
    const name = sticks > 1 ? stickWords(axisRoles[role], stick + 1) : axisRoles[role];
    const learn = dialogButton(set, setAxis(name), () => {
      this.#task = { kind: 'axis', stick, role, moved: new MovedAxis(this.#pad.axes) };
      this.#parts.say(axisPrompts[role]);
    });
    const change = (now: AxisMap | null) => this.#change((map) => assignAxis(map, stick, role, now));
    return axis === null ? [rowOf(name, learn)] : axisRowsOf(name, axis, learn, change);
  }

  #buttonRows(role: ButtonRole, map: ControllerMap): HTMLElement[] {
    const { buttonRoles, removeButton: remove, addButton, add } = laterTexts().inputsDialog;
    const { buttonPrompt, gripPrompt } = laterTexts().inputsDialog;
    const name = buttonRoles[role];
    const chips = map.buttons[role].map((button) => {
      const words = this.#nameOf(button);
      return dialogButton(`${words} ✕`, remove(name, words), () =>
        this.#change((now) => removeButton(now, role, button, isStandardKey(this.#parts.key)), words),
      );
    });
    const learn = dialogButton(add, addButton(name), () => {
      const pressed = new PressedButton(this.#pad.buttons);
      const isGrip = role === 'grip';
      this.#task = isGrip
        ? { kind: 'grip', pressed, moved: new MovedAxis(this.#pad.axes) }
        : { kind: 'button', role, pressed };
      this.#parts.say(isGrip ? gripPrompt : buttonPrompt(name));
    });
    const pedal = role === 'grip' ? map.gripAxis : null;
    const change = (axis: AxisMap | null) => this.#change((now) => assignGripAxis(now, axis));
    const row = rowOf(name, ...chips, learn);
    return pedal === null ? [row] : [row, ...axisRowsOf(name, pedal, null, change)];
  }

  #nameOf(button: number): string {
    return buttonName(button, isStandardKey(this.#parts.key));
  }

  /** The first press begins, the second ends it. */
  #measure(): HTMLButtonElement {
    const { measure, measured, measurePrompt } = laterTexts().inputsDialog;
    const isRunning = this.#task?.kind === 'range';
    const button = dialogButton(isRunning ? measured : measure, isRunning ? measured : measure, () => {
      const { draft, say } = this.#parts;
      const task = this.#task;
      const now = draft.peek();
      if (now === null) return;
      if (task?.kind === 'range') {
        this.cancel();
        const { map, still } = task.run.finish(now);
        draft.value = { ...map };
        say(measuredWords(still));
        return;
      }
      this.#task = { kind: 'range', run: new Calibration(this.#pad.axes) };
      // Drawn anew, with the button's other words.
      draft.value = { ...now };
      say(measurePrompt);
    });
    button.dataset.running = String(isRunning);
    return button;
  }

  /** What the hand has shown. @param what by its name */
  #apply(what: string, act: (map: ControllerMap) => MapChange): void {
    this.cancel();
    const isDone = this.#change(act, what);
    if (isDone) this.#parts.say(laterTexts().inputsDialog.found(capital(what)));
  }

  /** @returns whether it was not refused */
  #change(act: (map: ControllerMap) => MapChange, what = ''): boolean {
    const { draft, say } = this.#parts;
    const now = draft.peek();
    if (now === null) return false;
    const change = act(now);
    if ('map' in change) draft.value = change.map;
    else say(mapRefusalWords(what, change));
    return 'map' in change;
  }
}

/** An axis and how it counts. @param learn the button that sets another one */
function axisRowsOf(
  name: string,
  axis: AxisMap,
  learn: HTMLElement | null,
  change: (now: AxisMap | null) => void,
): HTMLElement[] {
  const words = laterTexts().inputsDialog;
  const [label, box] = checkOf(words.inverted, words.invertedOf(name), (inverted) =>
    change({ ...axis, inverted }),
  );
  box.checked = axis.inverted;
  const scale = { min: DEAD_ZONES.least, max: DEAD_ZONES.most, step: DEAD_ZONE_STEP };
  const zone = sliderOf(words.deadZoneOf(name), scale, () => {});
  zone.value = String(axis.deadZone);
  const shown = document.createElement('output');
  const show = () => {
    shown.textContent = words.deadZone(Math.round(zone.valueAsNumber * 100));
  };
  show();
  zone.addEventListener('input', show);
  zone.addEventListener('change', () => change({ ...axis, deadZone: zone.valueAsNumber }));
  const index = words.axis(axis.axis + 1);
  const remove = dialogButton(`${index} ✕`, words.removeAxis(name, index), () => change(null));
  return [rowOf(name, remove, ...(learn === null ? [] : [learn])), rowOf('', label, shown, zone)];
}
