import { afterEach, expect, test } from 'vitest';
import { EMPTY_MAP, STANDARD_MAP } from '../take/drive/controller-map.ts';
import {
  buttonName,
  keyRefusalWords,
  mapRefusalWords,
  measuredWords,
  missingWords,
} from './inputs-dialog-words.ts';
import { speak } from './language.ts';

afterEach(() => speak('en'));

test('each refusal says what to do, in both languages', async () => {
  for (const language of ['en', 'de'] as const) {
    await speak(language);
    const said = [
      keyRefusalWords('KeyX', { reason: 'last-stop' }),
      keyRefusalWords('KeyR', { reason: 'taken', by: 'release' }),
      keyRefusalWords('F9', { reason: 'always-stops' }),
      keyRefusalWords('Tab', { reason: 'reserved' }),
      keyRefusalWords('KeyQ', { reason: 'full' }),
      mapRefusalWords('axis 2', { reason: 'taken', by: 'left' }),
      mapRefusalWords('button 2', { reason: 'taken', by: 'grip' }),
      mapRefusalWords('button 2', { reason: 'keeps-stop' }),
    ];
    expect(new Set(said).size).toBe(said.length);
    for (const each of said) expect(each).toMatch(/^\p{Lu}.*\.$/u);
  }
  await speak('en');
  expect(keyRefusalWords('KeyR', { reason: 'taken', by: 'release' })).toBe(
    'R is taken: Release STOP (hold). Remove it there first.',
  );
  expect(mapRefusalWords('axis 2', { reason: 'taken', by: 'left' })).toMatch(/^Axis 2 is taken: Turn\./);
});

test('a button has the name that is written on a standard gamepad, or its number', () => {
  expect([buttonName(1, true), buttonName(12, true), buttonName(20, true), buttonName(1, false)]).toEqual([
    ...['B', '↑', 'button 21', 'button 2'],
  ]);
});

test('says what a device lacks, and what was measured', () => {
  expect(missingWords(EMPTY_MAP)).toMatch(/without a grip/);
  expect(missingWords(STANDARD_MAP)).toBe(null);
  expect(measuredWords([])).toBe('Measured. Not saved yet.');
  expect(measuredWords([0, 3])).toBe('Measured, except what did not move: axis 1, axis 4.');
});
