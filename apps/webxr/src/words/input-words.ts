/** What the page says about keys, devices and the speed that the operator chooses. */
import { type KeyMap, type KeyRole, mainKey } from '../take/drive/key-map.ts';
import { keyboardLayout } from '../take/drive/keyboard-layout.ts';
import { texts } from './language.ts';
import { fixed } from './numbers.ts';
import type { Words } from './words.ts';

/** What is written on keys of a US keyboard that have no letter or digit. */
const SYMBOLS: Readonly<Record<string, string>> = {
  ArrowUp: '↑',
  ArrowDown: '↓',
  ArrowLeft: '←',
  ArrowRight: '→',
  Comma: ',',
  Period: '.',
  Slash: '/',
  Backslash: '\\',
  Semicolon: ';',
  Quote: "'",
  Minus: '-',
  Equal: '=',
  BracketLeft: '[',
  BracketRight: ']',
  Backquote: '`',
  Add: '+',
  Subtract: '-',
  Multiply: '*',
  Divide: '/',
  Decimal: '.',
};

/** @param code KeyboardEvent.code @returns what is written on this key, by the browser's word or as on a US keyboard */
export function keyName(code: string): string {
  const { keyNames, keypad } = texts().inputs;
  const named = keyNames[code];
  if (named !== undefined) return named;
  const pad = /^Numpad(.+)$/.exec(code)?.[1];
  if (pad !== undefined) return keypad(SYMBOLS[pad] ?? pad);
  const typed = keyboardLayout.value.get(code)?.trim() ?? '';
  // ß has no capital that anybody knows.
  if (typed !== '') return typed.toUpperCase().length === typed.length ? typed.toUpperCase() : typed;
  return (
    SYMBOLS[code] ?? /^(?:Key|Digit)(.)$/.exec(code)?.[1] ?? code.replaceAll(/(?<=[a-z])(?=[A-Z0-9])/g, ' ')
  );
}

/** A title with the key of this role in brackets at its end, in place of the one that is there. */
export function withKey(title: string, keys: KeyMap, role: KeyRole): string {
  const bare = title.replace(/ \([^()]*\)$/, '');
  const code = mainKey(keys, role);
  return code === undefined ? bare : `${bare} (${keyName(code)})`;
}

/** A piece of the hint beside the controls: words, or a key's name. */
export interface HintPart {
  readonly text: string;
  readonly isKey: boolean;
}

/** The hint beside the controls, one list for each thing that keys do. What has no key is left out; a question mark always asks for help. */
export function hintParts(keys: KeyMap): HintPart[][] {
  const first = (...roles: readonly KeyRole[]) => roles.flatMap((role) => mainKey(keys, role) ?? []);
  const named: Record<string, readonly string[]> = {
    grip: first('grip').map(keyName),
    ways: first('forward', 'left', 'back', 'right').map(keyName),
    estop: first('estop').map(keyName),
    help: ['?'],
  };
  return Object.values(texts().inputs.hint).flatMap((template) => {
    const parts = template.split(/\{(.+?)\}/).flatMap((piece, i): HintPart[] => {
      if (i % 2 === 0) return piece === '' ? [] : [{ text: piece, isKey: false }];
      return (named[piece] ?? []).map((name) => ({ text: name, isKey: true }));
    });
    return parts.some(({ isKey }) => isKey) ? [parts] : [];
  });
}

/** The most characters of a device's name that are shown. Chosen: a line of the dialog; input-words.test.ts holds it. */
const MOST_NAME = 60;

/** What a device calls itself, without the numbers of its maker. */
export function controllerName(id: string | undefined): string {
  const name = (id ?? '').replace(/\s*\((?:STANDARD GAMEPAD\s*)?(?:Vendor:.*)?\)\s*$/i, '').trim();
  return name === '' ? texts().inputs.unnamed : name.slice(0, MOST_NAME);
}

/** @param maxLinear the most that the robot ever drives, m/s; 0 while it is not known */
export function speedShareWords(share: number, maxLinear: number): string {
  const { speedShare, speedKnown } = texts().inputs;
  const percent = Math.round(share * 100);
  return maxLinear > 0 ? speedKnown(percent, fixed(share * maxLinear, 2)) : speedShare(percent);
}

/** How fast the robot is, with what its operator has chosen where that is less than all. */
export function withChosenSpeed(words: Words, share: number): Words {
  if (share >= 1) return words;
  return { ...words, text: `${words.text} (${texts().inputs.speedChosen(Math.round(share * 100))})` };
}
