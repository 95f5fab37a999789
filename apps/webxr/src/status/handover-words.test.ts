import type { HandoverEnd } from '@farpoint/operator';
import { expect, it } from 'vitest';
import { askedWords, handoverEndWords, menuTakeBack, waitingWords } from './handover-words.ts';

const from = { number: 1, name: 'Ada' };
const to = { number: 2, name: 'Bob', claimed: true } as const;

it('says who wants what, and marks a name that nothing proves', () => {
  expect(askedWords({ kind: 'offer', from, to }).text).toBe('Ada offers you the drive');
  expect(askedWords({ kind: 'ask', from: to, to: from }).text).toBe('“Bob” asks to drive');
  expect(waitingWords({ kind: 'offer', from, to })).toBe('You have offered “Bob” the drive');
});

it.each<[HandoverEnd, string, string]>([
  ['accepted', '“Bob” drives now.', 'Ada has handed you the drive. Press the grip anew to drive.'],
  [
    'refused',
    '“Bob” has refused: the drive has not changed hands.',
    'Refused: the drive has not changed hands.',
  ],
  ['withdrawn', 'Your offer of the drive was taken back.', 'Ada’s offer of the drive was taken back.'],
  [
    'expired',
    'Your offer of the drive was not answered in time.',
    'Ada’s offer of the drive was not answered in time.',
  ],
  [
    'left',
    'Your offer of the drive has ended: “Bob” has left.',
    'Ada’s offer of the drive has ended: Ada has left.',
  ],
  [
    'estop',
    'Your offer of the drive has ended: STOP was pressed.',
    'Ada’s offer of the drive has ended: STOP was pressed.',
  ],
])('says to both what has become of an offer: %s', (ended, maker, other) => {
  const words = (yours: boolean) => handoverEndWords({ kind: 'offer', from, to, yours, ended }).text;
  expect([words(true), words(false)]).toEqual([maker, other]);
});

it('tells who asked that it drives now', () => {
  const asked = { kind: 'ask', from, to, ended: 'accepted' } as const;
  expect(handoverEndWords({ ...asked, yours: true }).text).toContain('“Bob” has handed you the drive');
  expect(handoverEndWords({ ...asked, yours: false }).text).toBe('Ada drives now.');
});

it('says how a request or an offer is taken back', () => {
  expect(menuTakeBack(null)).toBeNull();
  const id = 7;
  expect(menuTakeBack({ id, kind: 'offer', from, to })).toEqual({
    id,
    takeBack: 'Take back the offer to “Bob”',
  });
  expect(menuTakeBack({ id, kind: 'ask', from: to, to: from })?.takeBack).toBe('Ask Ada no more');
});
