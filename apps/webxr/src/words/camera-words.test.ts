import { signal } from '@preact/signals-core';
import { expect, test } from 'vitest';
import { cameraWords } from './camera-words.ts';

const words = (on: boolean, age: number | null, fault: string | null) => {
  const camera = { index: 0, name: 'Front', on: signal(on) };
  return cameraWords({ camera, ageMs: signal(age), fault: signal(fault) });
};

test('each state of a camera says what it is', () => {
  expect(words(true, null, null)).toEqual({ state: 'waiting', text: 'waiting', reason: null });
  expect(words(true, 57, null)).toEqual({ state: 'live', text: '60 ms', reason: null });
  expect(words(true, 3210, null)).toEqual({ state: 'frozen', text: 'frozen, 3.2 s', reason: null });
  expect(words(true, null, 'unplugged')).toEqual({ state: 'fault', text: 'no picture', reason: 'unplugged' });
  expect(words(true, 3210, 'unplugged')).toEqual({
    ...{ state: 'fault', text: 'fault, 3.2 s', reason: 'unplugged' },
  });
  expect(words(false, 57, 'unplugged')).toEqual({ state: 'off', text: 'hidden', reason: null });
});
