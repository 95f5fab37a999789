import { expect, it } from 'vitest';
import { RecentChecks } from './recent-checks.ts';

function check(id: number, attribute = 0): Buffer {
  const bytes = Buffer.alloc(28, attribute);
  bytes.writeUInt32BE(id, 8);
  bytes.fill(1, 12, 20);
  return bytes;
}

it('tells a new check from one that is repeated, and from one that comes from elsewhere', () => {
  const recent = new RecentChecks();
  expect(recent.note(check(1), 'a', 1)).toBe('new');
  expect(recent.note(check(2), 'a', 1)).toBe('new');
  expect(recent.note(check(1, 7), 'a', 1)).toBe('again');
  expect(recent.note(check(1), 'a', 2)).toBe('moved');
  expect(recent.note(check(1), 'b', 1)).toBe('moved');
  // The first address stays the peer's.
  expect(recent.note(check(1), 'a', 1)).toBe('again');
});

it('forgets the oldest', () => {
  const recent = new RecentChecks();
  for (let id = 0; id < 257; id++) expect(recent.note(check(id), 'a', 1)).toBe('new');
  expect(recent.note(check(1), 'a', 1)).toBe('again');
  expect(recent.note(check(0), 'a', 1)).toBe('new');
});
