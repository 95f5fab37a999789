/** One connected controller in the dialog: what it reads now, what its axes and buttons do, and how far they go. */
import { effect } from '@preact/signals-core';
import { DEAD_ZONES, shapedDeflection } from '../drive/axis-map.ts';
import { Calibration, MovedAxis, PressedButton } from '../drive/controller-learning.ts';
import {
  AXIS_ROLES,
  type AxisRole,
  assignButton,
  BUTTON_ROLES,
  type ButtonChange,
  type ButtonRole,
  type ControllerMap,
  canDrive,
  removeButton,
  withAxis,
} from '../drive/controller-map.ts';
import type { GamepadState } from '../drive/gamepad-input.ts';
import { isStandardKey } from '../drive/input-choices.ts';
import type { InputSettings } from '../drive/input-settings.ts';
import {
  axisPrompts,
  axisRoleWords,
  buttonRefusalWords,
  buttonRoleWords,
  controllerWords,
  stillWords,
} from '../status/input-words.ts';
import { checkOf, dialogButton, keepingFocus } from './dialog-parts.ts';
import { rowOf, sliderOf } from './panel-parts.ts';

/** What the hand is asked to do. */
type Task =
  | { readonly kind: 'axis'; readonly stick: number; readonly role: AxisRole; readonly run: MovedAxis }
  | { readonly kind: 'button'; readonly role: ButtonRole; readonly run: PressedButton }
  | { readonly kind: 'range'; readonly run: Calibration };

export class ControllerControls {
  readonly element = document.createElement('div');
  readonly dispose: () => void;
  readonly #key: string;
  readonly #settings: InputSettings;
  readonly #say: (text: string) => void;
  readonly #live = document.createElement('p');
  readonly #state = document.createElement('p');
  readonly #rows = document.createElement('div');
  readonly #measure = dialogButton('', '', () => this.#calibrate());
  #pad: GamepadState = { axes: [], buttons: [] };
  #task: Task | null = null;

  /** @param key of the controller @param name that people read */
  constructor(key: string, name: string, settings: InputSettings, say: (text: string) => void) {
    this.#key = key;
    this.#settings = settings;
    this.#say = say;
    const title = document.createElement('h3');
    title.textContent = name;
    this.#live.className = 'live';
    this.#live.ariaHidden = 'true';
    this.#rows.className = 'roles';
    this.#state.dataset.tone = 'warning';
    const reset = dialogButton('Reset', `Reset ${name}`, () => {
      this.cancel();
      settings.setController(key, null);
      say('The controller does what is usual.');
    });
    this.element.append(title, this.#state, this.#live, this.#rows, rowOf('', this.#measure, reset));
    this.cancel();
    this.dispose = effect(() => {
      const map = settings.mapOf(key);
      const words = controllerWords(settings.isUnknown(key), canDrive(map));
      this.#state.hidden = words === null;
      this.#state.textContent = words;
      keepingFocus(this.#rows, () => this.#rows.replaceChildren(...this.#rowsOf(map)));
    });
  }

  /** Leaves what the hand was asked to do. */
  cancel(): void {
    this.#task = null;
    this.#measure.textContent = 'Measure the axes';
    this.#measure.ariaLabel = 'Measure the axes';
  }

  /** Call this often. @param pad its state now */
  tick(pad: GamepadState): void {
    this.#pad = pad;
    this.#showLive(pad);
    const task = this.#task;
    if (task === null) return;
    if (task.kind === 'range') {
      task.run.see(pad.axes);
    } else if (task.kind === 'axis') {
      const axis = task.run.see(pad.axes);
      if (axis === null) return;
      this.cancel();
      this.#set(withAxis(this.#map, task.stick, task.role, axis), `Axis ${axis.axis + 1}. Saved.`);
    } else {
      const button = task.run.see(pad.buttons);
      if (button === null) return;
      this.cancel();
      this.#apply(button, assignButton(this.#map, task.role, button));
    }
  }

  get #map(): ControllerMap {
    return this.#settings.mapOf(this.#key);
  }

  #showLive({ axes, buttons }: GamepadState): void {
    const [stick] = this.#map.sticks;
    const wish = (['forward', 'left'] as const).map((role) => {
      const map = stick?.[role] ?? null;
      return map === null ? '–' : shapedDeflection(axes[map.axis], map).toFixed(2);
    });
    const down = buttons.flatMap(({ pressed }, index) => (pressed ? [index + 1] : []));
    const read = axes.map((value) => (value ?? 0).toFixed(2)).join('  ');
    this.#live.textContent = `Axes ${read}\nForward ${wish[0]}  left ${wish[1]}\nButtons ${down.join(', ') || '–'}`;
  }

  #rowsOf(map: ControllerMap): HTMLElement[] {
    const axes = map.sticks.flatMap((_, stick) =>
      AXIS_ROLES.flatMap((role) => this.#axisRows(map, stick, role)),
    );
    return [...axes, ...BUTTON_ROLES.map((role) => this.#buttonRow(role, map.buttons[role]))];
  }

  #axisRows(map: ControllerMap, stick: number, role: AxisRole): HTMLElement[] {
    const which = map.sticks.length > 1 ? `, stick ${stick + 1}` : '';
    const name = `${axisRoleWords[role]}${which}`;
    const axis = map.sticks[stick]?.[role] ?? null;
    const set = dialogButton('Set', `${name}: set the axis`, () => {
      this.cancel();
      this.#task = { kind: 'axis', stick, role, run: new MovedAxis(this.#pad.axes) };
      this.#say(axisPrompts[role]);
    });
    if (axis === null) return [rowOf(name, set)];
    const change = (now: typeof axis | null) => this.#set(withAxis(this.#map, stick, role, now), 'Saved.');
    const [label, box] = checkOf('inverted', (inverted) => change({ ...axis, inverted }));
    box.checked = axis.inverted;
    box.ariaLabel = `${name}: inverted`;
    const scale = { min: DEAD_ZONES.least, max: DEAD_ZONES.most, step: 0.02 };
    const zone = sliderOf(`${name}: dead zone`, scale, () => {});
    zone.value = String(axis.deadZone);
    const shown = document.createElement('output');
    const show = () => {
      shown.textContent = `dead zone ${Math.round(zone.valueAsNumber * 100)} %`;
    };
    show();
    zone.addEventListener('input', show);
    zone.addEventListener('change', () => change({ ...axis, deadZone: zone.valueAsNumber }));
    const remove = dialogButton(`Axis ${axis.axis + 1} ✕`, `${name}: remove axis ${axis.axis + 1}`, () =>
      change(null),
    );
    return [rowOf(name, remove, set), rowOf('', label, shown, zone)];
  }

  #buttonRow(role: ButtonRole, buttons: readonly number[]): HTMLElement {
    const name = buttonRoleWords[role];
    const chips = buttons.map((button) =>
      dialogButton(`${button + 1} ✕`, `${name}: remove button ${button + 1}`, () =>
        this.#apply(button, removeButton(this.#map, role, button, isStandardKey(this.#key))),
      ),
    );
    const add = dialogButton('Add', `${name}: add a button`, () => {
      this.cancel();
      this.#task = { kind: 'button', role, run: new PressedButton(this.#pad.buttons) };
      this.#say(`${name}: press the button.`);
    });
    return rowOf(name, ...chips, add);
  }

  /** The first press begins, the second ends it. */
  #calibrate(): void {
    const task = this.#task;
    if (task?.kind === 'range') {
      this.cancel();
      const { map, still } = task.run.finish(this.#map);
      this.#set(map, stillWords(still));
      return;
    }
    this.cancel();
    this.#task = { kind: 'range', run: new Calibration(this.#pad.axes) };
    this.#measure.textContent = 'Done';
    this.#measure.ariaLabel = 'Measure the axes: done';
    this.#say(
      'Where the axes are now is their rest. Move each of them all the way, let go, then press Done.',
    );
  }

  #set(map: ControllerMap, text: string): void {
    this.#settings.setController(this.#key, map);
    this.#say(text);
  }

  #apply(button: number, change: ButtonChange): void {
    if ('map' in change) this.#set(change.map, 'Saved.');
    else this.#say(buttonRefusalWords(button, change));
  }
}
