import { expect, test } from 'vitest';
import { UnansweredSessions } from './unanswered-sessions.ts';

const session = (address: string, id = 'r') => ({ robot: { id }, operator: { peer: { address } } });

test('a source has three places at each robot, and gets them back', () => {
  const asked = new UnansweredSessions();
  const [first, ...others] = Array.from({ length: 3 }, () => session('192.0.2.7'));
  for (const one of [first!, ...others]) {
    expect(asked.hasRoom('r', '192.0.2.7')).toBe(true);
    asked.add(one);
  }
  expect(asked.hasRoom('r', '192.0.2.7')).toBe(false);
  expect(asked.hasRoom('r', '192.0.2.8')).toBe(true);
  expect(asked.hasRoom('s', '192.0.2.7')).toBe(true);
  asked.remove(first!);
  asked.remove(first!);
  expect(asked.hasRoom('r', '192.0.2.7')).toBe(true);
});

test('an IPv6 /64 is one source', () => {
  const asked = new UnansweredSessions();
  for (let n = 1; n <= 3; n++) asked.add(session(`2001:db8::${n}`));
  expect(asked.hasRoom('r', '2001:db8::9')).toBe(false);
  expect(asked.hasRoom('r', '2001:db8:0:1::9')).toBe(true);
});

test('a proxy on this machine has no limit', () => {
  const asked = new UnansweredSessions();
  for (let n = 0; n < 10; n++) asked.add(session('127.0.0.1'));
  expect(asked.hasRoom('r', '127.0.0.1')).toBe(true);
});
