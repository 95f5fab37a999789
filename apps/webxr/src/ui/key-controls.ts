/** The list of what each key does, in the dialog for keys and controllers. */
import { effect } from '@preact/signals-core';
import type { InputSettings } from '../drive/input-settings.ts';
import {
  assignKey,
  KEY_ROLES,
  type KeyChange,
  type KeyRole,
  removeKey,
  roleOf,
  STOP_KEY,
} from '../drive/key-map.ts';
import { keyName, keyRefusalWords, keyRoleWords } from '../status/input-words.ts';
import { checkOf, dialogButton, keepingFocus } from './dialog-parts.ts';
import { rowOf } from './panel-parts.ts';

export class KeyControls {
  readonly #settings: InputSettings;
  readonly #say: (text: string) => void;
  /** The role that the next key gets. */
  #waiting: KeyRole | null = null;
  readonly #list = document.createElement('div');

  constructor(element: HTMLElement, settings: InputSettings, say: (text: string) => void) {
    this.#settings = settings;
    this.#say = say;
    const title = document.createElement('h3');
    title.textContent = 'Keys';
    this.#list.className = 'roles';
    element.append(title, oneHandedCheck(settings), this.#list, this.#reset());
    effect(() => {
      const { value: keys } = settings.keys;
      keepingFocus(this.#list, () => {
        this.#list.replaceChildren(...KEY_ROLES.map((role) => this.#row(role, keys[role])));
      });
    });
    // Before the page's own listener: a key that is being chosen does nothing else.
    window.addEventListener('keydown', (event) => this.#onKey(event), true);
  }

  /** Whether the next key is chosen for something. */
  get isWaiting(): boolean {
    return this.#waiting !== null;
  }

  /** The next key does what it usually does. */
  cancel(): void {
    this.#waiting = null;
  }

  #row(role: KeyRole, codes: readonly string[]): HTMLElement {
    const name = keyRoleWords[role];
    const chips = codes.map((code) => {
      const text = code === STOP_KEY ? keyName(code) : `${keyName(code)} ✕`;
      return dialogButton(text, `${name}: remove ${keyName(code)}`, () =>
        this.#apply(code, removeKey(this.#settings.keys.peek(), role, code)),
      );
    });
    const add = dialogButton('Add', `${name}: add a key`, () => {
      this.#waiting = role;
      this.#say(`${name}: press the key. Escape leaves it.`);
    });
    return rowOf(name, ...chips, add);
  }

  #reset(): HTMLElement {
    return dialogButton('Reset keys', 'Reset keys', () => {
      this.cancel();
      this.#settings.resetKeys();
      this.#say('All keys do what is usual.');
    });
  }

  #onKey(event: KeyboardEvent): void {
    const role = this.#waiting;
    if (role === null || event.repeat) return;
    // STOP stops, whatever the dialog waits for.
    if (roleOf(this.#settings.keys.peek(), event.code) !== 'estop') {
      event.preventDefault();
      event.stopImmediatePropagation();
    }
    this.cancel();
    if (event.code === 'Escape') this.#say('Nothing was changed.');
    else this.#apply(event.code, assignKey(this.#settings.keys.peek(), role, event.code));
  }

  #apply(code: string, change: KeyChange): void {
    if (!('keys' in change)) {
      this.#say(keyRefusalWords(code, change));
      return;
    }
    this.#settings.keys.value = change.keys;
    this.#say('Saved.');
  }
}

function oneHandedCheck(settings: InputSettings): HTMLElement {
  const [label, box] = checkOf(
    'One key at a time: a key for a direction drives while it is held, without the grip',
    (checked) => {
      settings.oneHanded.value = checked;
    },
  );
  box.name = 'oneHanded';
  effect(() => {
    box.checked = settings.oneHanded.value;
  });
  return label;
}
