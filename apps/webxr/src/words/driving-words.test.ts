import { expect, test } from 'vitest';
import { missingGripWords, takenOverWords, unknownGamepadWords, vainGripWords } from './driving-words.ts';

test('whoever pushes without a grip is told what to hold, or why it would not help', () => {
  expect(missingGripWords('keyboard', 'nobody', null)).toMatch(/^Hold Space, too/);
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

test('a gamepad that cannot drive is named, or called this one', () => {
  expect(unknownGamepadWords('DragonRise Pad (Vendor: 0079)')).toMatch(
    /^DragonRise Pad cannot drive or stop/,
  );
  expect(unknownGamepadWords('')).toMatch(/^This gamepad cannot/);
});
