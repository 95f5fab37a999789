/** What each key does, in the dialog for inputs: presets for one hand or two, and each role’s keys. */
import { effect } from '@preact/signals-core';
import type { InputSettings } from '../../take/drive/input-settings.ts';
import {
  assignKey,
  KEY_PRESETS,
  KEY_ROLES,
  type KeyChange,
  type KeyMap,
  type KeyPreset,
  type KeyRole,
  removeKey,
  roleOf,
  SIDEWAYS_ROLES,
  STOP_KEY_ALWAYS,
} from '../../take/drive/key-map.ts';
import { keyName } from '../../words/input-words.ts';
import { keyRefusalWords } from '../../words/inputs-dialog-words.ts';
import { laterTexts } from '../../words/language.ts';
import { rowOf } from '../ui/panel-parts.ts';
import { dialogButton, headingOf, keepingFocus } from './dialog-parts.ts';

const PRESETS = Object.keys(KEY_PRESETS) as KeyPreset[];

export class KeyControls {
  readonly element = document.createElement('section');
  readonly #settings: InputSettings;
  readonly #say: (text: string) => void;
  /** The role that the next key gets. */
  #waiting: KeyRole | null = null;
  readonly #list = document.createElement('div');
  readonly #stop: () => void;
  readonly #onKeyDown = (event: KeyboardEvent) => this.#onKey(event);

  /** @param say tells what has come of a change */
  constructor(settings: InputSettings, say: (text: string) => void) {
    this.#settings = settings;
    this.#say = say;
    this.element.id = 'inputs-keys';
    this.#list.className = 'roles';
    const preset = document.createElement('select');
    preset.addEventListener('change', () => this.#choosePreset(preset.value));
    const { keysTitle, presetTitle } = laterTexts().inputsDialog;
    preset.ariaLabel = presetTitle;
    this.element.append(headingOf(keysTitle), rowOf(presetTitle, preset), this.#list, this.#reset());
    this.#stop = effect(() => {
      const { value: keys } = settings.keys;
      keepingFocus(this.#list, () => {
        this.#list.replaceChildren(...this.#roles().map((role) => this.#row(role, keys[role])));
      });
      showPresets(preset, keys);
    });
    // Before the page's own listener: a key that is being chosen does nothing else.
    window.addEventListener('keydown', this.#onKeyDown, true);
  }

  dispose(): void {
    this.#waiting = null;
    window.removeEventListener('keydown', this.#onKeyDown, true);
    this.#stop();
  }

  /** Those that the robot can follow. */
  #roles(): readonly KeyRole[] {
    const isSideways = new Set<KeyRole>(SIDEWAYS_ROLES);
    return this.#settings.goesSideways.value ? KEY_ROLES : KEY_ROLES.filter((role) => !isSideways.has(role));
  }

  #row(role: KeyRole, codes: readonly string[]): HTMLElement {
    const { keyRoles, removeKey: remove, add, addKey, keyPrompt } = laterTexts().inputsDialog;
    const name = keyRoles[role];
    const chips = codes.map((code) =>
      dialogButton(`${keyName(code)} ✕`, remove(name, keyName(code)), () =>
        this.#apply(code, removeKey(this.#settings.keys.peek(), role, code)),
      ),
    );
    const always = role === 'estop' ? [keyCap(STOP_KEY_ALWAYS)] : [];
    const adds = dialogButton(add, addKey(name), () => {
      this.#waiting = role;
      this.#say(keyPrompt(name));
    });
    return rowOf(name, ...always, ...chips, adds);
  }

  #reset(): HTMLElement {
    const { resetKeys } = laterTexts().inputsDialog;
    return dialogButton(resetKeys, resetKeys, () => {
      this.#waiting = null;
      this.#settings.usePreset('both');
      this.#say(laterTexts().inputsDialog.keysReset);
    });
  }

  #choosePreset(value: string): void {
    const preset = PRESETS.find((each) => each === value);
    if (preset === undefined) return;
    this.#waiting = null;
    this.#settings.usePreset(preset);
    const { presetChosen, presets } = laterTexts().inputsDialog;
    this.#say(presetChosen(presets[preset]));
  }

  #onKey(event: KeyboardEvent): void {
    const role = this.#waiting;
    if (role === null || event.repeat) return;
    const { code } = event;
    const keys = this.#settings.keys.peek();
    // STOP stops, whatever the dialog waits for.
    if (code !== STOP_KEY_ALWAYS && roleOf(keys, code) !== 'estop') {
      event.preventDefault();
      event.stopImmediatePropagation();
    }
    this.#waiting = null;
    if (code === 'Escape') this.#say(laterTexts().inputsDialog.unchanged);
    else this.#apply(code, assignKey(keys, role, code));
  }

  #apply(code: string, change: KeyChange): void {
    if (!('keys' in change)) {
      this.#say(keyRefusalWords(code, change));
      return;
    }
    this.#settings.keys.value = change.keys;
    this.#say(laterTexts().inputsDialog.saved);
  }
}

/** The presets, and what is chosen: one of them, or keys of the operator's own. */
function showPresets(select: HTMLSelectElement, keys: KeyMap): void {
  const { presets, ownKeys } = laterTexts().inputsDialog;
  const chosen = PRESETS.find((preset) =>
    KEY_ROLES.every((role) => KEY_PRESETS[preset][role].join() === keys[role].join()),
  );
  const options = PRESETS.map((preset) => new Option(presets[preset], preset));
  select.replaceChildren(...options, ...(chosen === undefined ? [new Option(ownKeys, 'own')] : []));
  select.value = chosen ?? 'own';
}

function keyCap(code: string): HTMLElement {
  const key = document.createElement('kbd');
  key.textContent = keyName(code);
  return key;
}
