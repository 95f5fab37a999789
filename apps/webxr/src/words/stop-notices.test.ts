import type { Operators } from '@farpoint/operator';
import type { EstopCause } from '@farpoint/protocol';
import { expect, it } from 'vitest';
import { pressedNotice, presserWords, releasedNotice } from './stop-notices.ts';

const ada = { number: 1, name: 'Ada', role: 'drive', drives: false, you: true } as const;
const bo = { number: 2, name: 'Bo', role: 'drive', drives: true, you: false } as const;
const cy = { number: 3, name: 'Cy', role: 'supervise', drives: false, you: false, claimed: true } as const;
const listOf = (...operators: Operators['operators']): Operators => ({ type: 'operators', operators });
const cause: EstopCause = { type: 'estopCause', latch: 1, pressedBy: 'Bo', yours: false, release: 'driver' };
const by = 'operator';

it('names who pressed STOP, unless it was this operator or the robot', () => {
  expect(pressedNotice({ by }, cause, listOf(ada, bo))).toBe('Bo has pressed STOP.');
  expect(pressedNotice({ by }, cause, listOf(ada, { ...bo, claimed: true }))).toBe('“Bo” has pressed STOP.');
  expect(pressedNotice({ by }, { ...cause, pressedBy: undefined }, null)).toBe(
    'Another operator has pressed STOP.',
  );
  expect(pressedNotice({ by }, { ...cause, yours: true }, null)).toBeNull();
  expect(pressedNotice({ by: 'robot' }, cause, null)).toBeNull();
  expect([presserWords({ ...cause, yours: true }, null), presserWords(null, null)]).toEqual(['you', null]);
});

it('names who has released it where only one other could', () => {
  const released = (operators: Operators | null, holder: 'you' | 'other' | 'nobody' = 'other') =>
    releasedNotice({}, cause, { operators, holder });
  expect(released(listOf(ada, bo))).toBe('Bo has released the emergency stop.');
  const another = 'Another operator has released the emergency stop.';
  expect(released(listOf(ada, bo, cy))).toBe(another);
  expect(released(listOf(ada, { ...bo, away: true }, cy))).toBe('“Cy” has released the emergency stop.');
  expect(released({ ...listOf(ada, bo), more: 1 })).toBe(another);
  expect(released(listOf(ada, { ...bo, drives: false }), 'nobody')).toBe(
    'Bo has released the emergency stop.',
  );
  expect([released(listOf(ada)), released(null)]).toEqual([null, null]);
});

it('knows that a supervisor has, where the robot lets nobody else', () => {
  const operators = listOf(ada, bo, cy);
  expect(releasedNotice({}, { ...cause, release: 'supervisor' }, { operators, holder: 'other' })).toBe(
    '“Cy” has released the emergency stop.',
  );
  expect(releasedNotice({ releasedAt: 'robot' }, cause, { operators, holder: 'other' })).toBe(
    'The emergency stop has been released at the robot.',
  );
});
