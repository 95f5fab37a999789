import { expect, test } from 'vitest';
import { missingGripWords, takenOverWords, vainGripWords } from './driving-words.ts';

test.each([
  ['keyboard', 'nobody', null, 'Hold Space, too'],
  ['gamepad', 'you', 'drive', 'Hold a shoulder button, too'],
  ['headset', 'nobody', 'supervise', 'Squeeze the grip, too'],
  ['keyboard', 'other', 'drive', 'Press Take over'],
  ['keyboard', 'nobody', 'watch', 'lets you watch'],
] as const)('%s without its grip, while %s drives and the grant is %s', (device, holder, role, words) => {
  expect(missingGripWords(device, holder, role)).toContain(words);
});

test('who is displaced is told by whom', () => {
  expect(takenOverWords('Grace')).toBe('Grace has taken over and drives now. You do not.');
  expect(takenOverWords(null)).toMatch(/^Another operator has taken over/);
});

test('a hand that holds on in vain is told what to do, for as long as it does', () => {
  expect(vainGripWords({ gripLost: null, takenOverBy: null })).toBeNull();
  expect(vainGripWords({ gripLost: 'path-lost', takenOverBy: null })).toEqual({
    title: 'Let go of the grip',
    text: 'The connection was lost while you held the grip. Let go of it, then drive.',
  });
  // The takeover is the cause.
  expect(vainGripWords({ gripLost: 'let-go', takenOverBy: 'Grace' })?.title).toBe('Taken over');
});
