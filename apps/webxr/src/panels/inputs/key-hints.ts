/** The keys that the page names are those that count now: in the hint beside the controls, and in titles. */
import { effect } from '@preact/signals-core';
import { type KeyRole, mainKey } from '../../take/drive/key-map.ts';
import { inputSettings } from '../../take/drive/stored-inputs.ts';
import { hintParts, keyName } from '../../words/input-words.ts';
import { texts } from '../../words/language.ts';
import { elements } from '../ui/elements.ts';
import { followKey } from '../ui/key-title.ts';

/** Buttons that are always there, whose title ends with their key. */
const TITLED: readonly (readonly [element: HTMLElement, role: KeyRole])[] = [
  [elements.view, 'view'],
  [elements.dashboardOpen, 'dashboard'],
  [elements.latency, 'latency-test'],
  [elements.talk, 'talk'],
];

export function showKeyHints(): void {
  for (const [element, role] of TITLED) effect(() => followKey(element, role));
  const { estop, estopRelease, robotSwitch, talk, driveHint } = elements;
  effect(() => {
    const { titles } = texts().inputs;
    const { value: keys } = inputSettings.keys;
    const named = (role: KeyRole) => {
      const code = mainKey(keys, role);
      return code === undefined ? '' : keyName(code);
    };
    estop.title = titles.estop(named('estop'));
    // The rest keeps its words where nobody has a key for it.
    if (keys.release.length > 0) estopRelease.title = titles.release(named('release'));
    if (keys['next-robot'].length > 0) robotSwitch.title = titles.robotSwitch(named('next-robot'));
    showKey(estopRelease, named('release'));
    showKey(talk, named('talk'));
  });
  effect(() => {
    const pieces = hintParts(inputSettings.keys.value).flatMap((parts, i) => [
      ...(i === 0 ? [] : [' · ']),
      ...parts.map(({ text, isKey }) => (isKey ? keyCap(text) : text)),
    ]);
    driveHint.replaceChildren(...pieces);
  });
}

/** Writes a button's key into it; without one, nothing is said of keys. */
function showKey(button: HTMLElement, name: string): void {
  const said = button.querySelector<HTMLElement>('.key');
  const key = said?.querySelector('kbd');
  if (said == null || key == null) return;
  said.hidden = name === '';
  key.textContent = name;
}

function keyCap(text: string): HTMLElement {
  const key = document.createElement('kbd');
  key.textContent = text;
  return key;
}
