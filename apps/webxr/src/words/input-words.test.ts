import { afterEach, expect, test } from 'vitest';
import { DEFAULT_KEYS, KEY_PRESETS, KEY_ROLES } from '../take/drive/key-map.ts';
import { keyboardLayout, readKeyboardLayout } from '../take/drive/keyboard-layout.ts';
import {
  controllerName,
  hintParts,
  keyName,
  speedShareWords,
  withChosenSpeed,
  withKey,
} from './input-words.ts';
import { speak } from './language.ts';

afterEach(async () => {
  keyboardLayout.value = new Map();
  await speak('en');
});

const hint = (keys = DEFAULT_KEYS) =>
  hintParts(keys).map((parts) => parts.map(({ text, isKey }) => (isKey ? `[${text}]` : text)).join(''));

test('a key is named by what is written on it', () => {
  expect(['KeyW', 'Digit5', 'ArrowUp', 'Space', 'ShiftLeft', 'BracketLeft'].map(keyName)).toEqual([
    ...['W', '5', '↑', 'Space', 'Left Shift', '['],
  ]);
  expect(['Numpad5', 'NumpadAdd', 'IntlBackslash'].map(keyName)).toEqual([
    'keypad 5',
    'keypad +',
    'Intl Backslash',
  ]);
});

test('where the browser tells what this keyboard has, that counts: also for a letter that is elsewhere', async () => {
  const layout = new Map([
    ['KeyY', 'z'],
    ['Minus', 'ß'],
    ['BracketLeft', 'ü'],
  ]);
  await readKeyboardLayout({ keyboard: { getLayoutMap: async () => layout } });
  expect(['KeyY', 'Minus', 'BracketLeft', 'KeyW', 'Space'].map(keyName)).toEqual([
    'Z',
    'ß',
    'Ü',
    'W',
    'Space',
  ]);
  await readKeyboardLayout({ keyboard: { getLayoutMap: () => Promise.reject(new Error('forbidden')) } });
  await readKeyboardLayout({});
  expect(keyName('KeyY')).toBe('Z');
});

test('the hint names the keys that count, in the page’s language, and leaves out what has none', async () => {
  expect(hint()).toEqual(['Hold [Space] and drive with [W][A][S][D]', '[X] stop', '[?] help']);
  expect(hint(KEY_PRESETS.right)[0]).toBe('Hold [Space] and drive with [I][J][K][L]');
  const none = { ...DEFAULT_KEYS, grip: [], forward: [], back: [], left: [], right: [], help: [] };
  expect(hint(none)).toEqual(['[X] stop', '[?] help']);
  await speak('de');
  expect(hint()[0]).toBe('[Leertaste] halten und mit [W][A][S][D] fahren');
});

test('a title ends with the key that counts, whatever it ended with before', () => {
  const keys = { ...DEFAULT_KEYS, dashboard: ['KeyK'], view: [] };
  for (const title of ['Dashboard', 'Dashboard (B)', 'Dashboard (K)'])
    expect(withKey(title, keys, 'dashboard')).toBe('Dashboard (K)');
  expect(withKey('View (V)', keys, 'view')).toBe('View');
});

test('every key of every preset has a name of its own', () => {
  for (const preset of Object.values(KEY_PRESETS)) {
    const names = KEY_ROLES.flatMap((role) => preset[role]).map(keyName);
    expect(new Set(names).size).toBe(names.length);
  }
});

test('a device has its own name, without the numbers of its maker', () => {
  expect(controllerName('Pad (STANDARD GAMEPAD Vendor: 045e Product: 0b13)')).toBe('Pad');
  expect(controllerName('Flight stick (Vendor: 06a3 Product: 0c2d)')).toBe('Flight stick');
  expect([controllerName(''), controllerName(undefined)]).toEqual(['Device', 'Device']);
  expect(controllerName('x'.repeat(500))).toHaveLength(60);
});

test('the chosen speed is told in m/s where the robot has said how fast it drives', () => {
  expect([speedShareWords(0.5, 0), speedShareWords(0.5, 1.5)]).toEqual(['50 %', '50 % · 0.75 m/s']);
});

test('the robot’s speed is told with the chosen share, where that is not all', () => {
  const words = { text: '0.10 m/s, at most 1.00', tone: 'neutral' } as const;
  expect(withChosenSpeed(words, 1)).toBe(words);
  expect(withChosenSpeed(words, 0.25)).toEqual({ ...words, text: '0.10 m/s, at most 1.00 (25 % chosen)' });
});
