import { expect, test } from 'vitest';
import { DEFAULT_KEYS } from '../drive/key-map.ts';
import {
  buttonRefusalWords,
  controllerName,
  controllerWords,
  keyName,
  keyRefusalWords,
  speedShareWords,
  stillWords,
} from './input-words.ts';

test('keys are named as they are written', () => {
  const codes = [
    'KeyX',
    'Digit1',
    'ArrowUp',
    'ShiftLeft',
    'Space',
    'Comma',
    'Numpad0',
    'PageUp',
    'NumpadAdd',
  ];
  expect(codes.map(keyName)).toEqual([
    ...['X', '1', '↑', 'Left Shift', 'Space', ',', 'Numpad 0', 'Page Up', 'Numpad Add'],
  ]);
  const names = Object.values(DEFAULT_KEYS).flat().map(keyName);
  expect(new Set(names).size).toBe(names.length);
});

test('each refusal says what to do', () => {
  expect(keyRefusalWords('KeyR', { reason: 'taken', by: 'release' })).toBe(
    'R is taken: Release STOP (hold). Remove it there first.',
  );
  expect(keyRefusalWords('KeyX', { reason: 'stops' })).toBe(
    'X always stops the robot: it can have no other use.',
  );
  expect(buttonRefusalWords(1, { reason: 'keeps-stop' })).toBe(
    'Button 2 keeps stopping the robot. Others can be added to it.',
  );
  expect(buttonRefusalWords(4, { reason: 'taken', by: 'grip' })).toContain('Grip (hold to drive)');
});

test('a controller that cannot drive says why', () => {
  expect(controllerWords(false, true)).toBe(null);
  expect(controllerWords(true, false)).toContain('It does nothing until then');
  expect(controllerWords(false, false)).toContain('a grip and an axis');
  expect(stillWords([])).toBe('Measured.');
  expect(stillWords([0, 2])).toBe('Measured, but for axes 1, 3: not moved.');
});

test('a controller has a name to read', () => {
  expect(controllerName('Xbox 360 Controller (XInput STANDARD GAMEPAD)')).toBe(
    'Xbox 360 Controller (XInput STANDARD GAMEPAD)',
  );
  expect(controllerName('Wheel (STANDARD GAMEPAD Vendor: 046d Product: c29b)')).toBe('Wheel');
  expect(controllerName('Joystick (Vendor: 06a3 Product: 0c2d)')).toBe('Joystick');
  expect([controllerName(''), controllerName(undefined)]).toEqual(['Controller', 'Controller']);
});

test('the chosen speed is said in figures', () => {
  expect(speedShareWords(0.5, 1.2)).toBe('50 % · 0.60 m/s');
  expect(speedShareWords(1, 0)).toBe('100 %');
});
