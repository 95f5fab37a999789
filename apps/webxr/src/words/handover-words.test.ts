import type { HandoverEnd, Operators } from '@farpoint/operator';
import { expect, it } from 'vitest';
import {
  askedWords,
  driverWords,
  handoverEndWords,
  listedNameWords,
  waitingWords,
} from './handover-words.ts';

const from = { number: 1, name: 'Ada' };
const to = { number: 2, name: 'Bob', claimed: true } as const;

it('says who wants what, and marks a name that nothing proves', () => {
  expect(askedWords({ kind: 'offer', from, to }).text).toBe('Ada offers you the drive');
  expect(askedWords({ kind: 'ask', from: to, to: from }).text).toBe('“Bob” asks to drive');
  expect(waitingWords({ kind: 'offer', from, to })).toBe('You have offered “Bob” the drive');
  expect(waitingWords({ kind: 'ask', from: to, to: from })).toBe('You have asked Ada for the drive');
  const here: Operators = {
    type: 'operators',
    operators: [{ ...to, role: 'drive', drives: false, you: false }],
  };
  expect([listedNameWords('Bob', here), listedNameWords('Ada', here), listedNameWords('Ada', null)]).toEqual([
    '“Bob”',
    'Ada',
    'Ada',
  ]);
});

it('names the driver by its grant, or else as it is listed', () => {
  const bob = { ...to, role: 'drive', drives: true, you: false } as const;
  const listOf = (you: boolean): Operators => ({ type: 'operators', operators: [{ ...bob, you }] });
  expect(driverWords({ driver: 'Ada' }, listOf(false))).toBe('Ada');
  expect(driverWords({}, listOf(false))).toBe('“Bob”');
  expect([driverWords({}, listOf(true)), driverWords({}, null)]).toEqual([null, null]);
});

it.each<[HandoverEnd, string | undefined, string | undefined]>([
  [
    'accepted',
    '“Bob” has accepted: “Bob” drives now.',
    'You drive now, by Ada’s offer. Press the grip anew to drive.',
  ],
  [
    'refused',
    '“Bob” has refused: the drive has not changed hands.',
    'Refused: the drive has not changed hands.',
  ],
  ['withdrawn', 'Your offer of the drive was taken back.', 'Ada’s offer of the drive was taken back.'],
  [
    'expired',
    '“Bob” did not answer: the drive has not changed hands.',
    'You did not answer Ada: the drive has not changed hands.',
  ],
  // Whoever drove knows it.
  ['driver-changed', undefined, 'Ada’s offer of the drive has ended: the driver has changed.'],
  [
    'left',
    'Your offer of the drive has ended: “Bob” has left.',
    'Ada’s offer of the drive has ended: Ada has left.',
  ],
  [
    'estop',
    'Your offer of the drive has ended: Cy pressed STOP.',
    'Ada’s offer of the drive has ended: Cy pressed STOP.',
  ],
])('says to both what has become of an offer: %s', (ended, maker, other) => {
  const words = (yours: boolean) => handoverEndWords({ kind: 'offer', from, to, yours, ended }, 'Cy')?.text;
  expect([words(true), words(false)]).toEqual([maker, other]);
});

it('tells who asked that it drives now', () => {
  const asked = { kind: 'ask', from, to, ended: 'accepted' } as const;
  expect(handoverEndWords({ ...asked, yours: true }, null)?.text).toBe(
    '“Bob” has accepted: you drive now. Press the grip anew to drive.',
  );
  expect(handoverEndWords({ ...asked, yours: false }, null)?.text).toBe('Ada drives now.');
});
