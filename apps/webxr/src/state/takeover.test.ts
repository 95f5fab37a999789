import { expect, test } from 'vitest';
import { Takeover } from './takeover.ts';

test('a takeover is told once, and lasts as long as the hand holds on', () => {
  const takeover = new Takeover();
  expect(takeover.onLease('other', 'Ada')).toBe(false);
  expect(takeover.onLease('you', null)).toBe(false);
  expect(takeover.onLease('other', 'Grace')).toBe(true);
  expect(takeover.onLease('other', 'Grace')).toBe(false);
  expect(takeover.by(true)).toBe('Grace');
  expect(takeover.by(false)).toBeNull();
  expect(takeover.by(true)).toBeNull();
});

test('handing over is no takeover, and neither is a new session', () => {
  const takeover = new Takeover();
  takeover.onLease('you', null);
  takeover.onLease('nobody', null);
  expect(takeover.onLease('other', 'Grace')).toBe(false);
  takeover.onLease('you', null);
  takeover.reset();
  expect(takeover.onLease('other', 'Grace')).toBe(false);
  expect(takeover.by(true)).toBeNull();
});

test('one without a name counts, and getting the lease back ends it', () => {
  const takeover = new Takeover();
  takeover.onLease('you', null);
  takeover.onLease('other', null);
  expect(takeover.by(true)).toBe('');
  takeover.onLease('you', null);
  expect(takeover.by(true)).toBeNull();
});

const own = {
  type: 'handover',
  id: 1,
  kind: 'offer',
  from: { number: 1, name: 'Ada' },
  to: { number: 2, name: 'Grace' },
  yours: true,
} as const;

test('an offer that is accepted is no takeover, also if others end with it', () => {
  const takeover = new Takeover();
  takeover.onLease('you', null);
  expect(takeover.onLease('other', 'Grace', true)).toBe(false);
  expect(takeover.by(true)).toBeNull();
  expect(takeover.onHandover({ ...own, kind: 'ask', yours: false, ended: 'driver-changed' }, true)).toBe(
    false,
  );
  expect(takeover.onHandover({ ...own, ended: 'accepted' }, false)).toBe(false);
  expect(takeover.by(true)).toBeNull();
  expect([takeover.isDisplaced(true), takeover.isDisplaced(false), takeover.isDisplaced(true)]).toEqual([
    true,
    false,
    false,
  ]);
});

test('whoever takes over in spite of an open offer is told once the offer has ended', () => {
  const takeover = new Takeover();
  takeover.onLease('you', null);
  takeover.onLease('other', 'Sue', true);
  expect(takeover.onHandover({ ...own, ended: 'driver-changed' }, false)).toBe(true);
  expect(takeover.by(true)).toBe('Sue');
  expect(takeover.onHandover({ ...own, ended: 'driver-changed' }, false)).toBe(false);
});
