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
