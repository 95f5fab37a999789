import { expect, test } from 'vitest';
import { inputSettings } from '../take/drive/stored-inputs.ts';
import { missingGripWords, takenOverWords, vainGripWords } from './driving-words.ts';

test('whoever pushes without a grip is told what to hold, or why it would not help', () => {
  expect(missingGripWords('keyboard', 'nobody', null)).toMatch(/^Hold Space, too/);
  const { keys } = inputSettings;
  const usual = keys.peek();
  keys.value = { ...usual, grip: ['Numpad0'] };
  expect(missingGripWords('keyboard', 'nobody', null)).toMatch(/^Hold keypad 0, too/);
  keys.value = { ...usual, grip: [] };
  expect(missingGripWords('keyboard', 'nobody', null)).toMatch(/^Hold the grip key, too/);
  keys.value = usual;
  expect(missingGripWords('headset', 'you', 'drive')).toMatch(/^Squeeze the grip, too/);
  expect(missingGripWords('keyboard', 'other', null)).toContain('Take over');
  expect(missingGripWords('keyboard', 'nobody', 'watch')).toContain('watch this robot');
});

test('a takeover is told with a name where there is one', () => {
  expect(takenOverWords('Grace')).toBe('Grace has taken over and drives now. You do not.');
  expect(takenOverWords('')).toMatch(/^Another operator/);
  expect(takenOverWords(null)).toMatch(/^Another operator/);
});

test('a hand that drives is told nothing', () => {
  expect(vainGripWords({ gripLost: null, takenOverBy: null })).toBeNull();
  expect(vainGripWords({ gripLost: 'late-reading', takenOverBy: null })?.text).toContain('not read');
});
