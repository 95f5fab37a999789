import { expect, test } from 'vitest';
import { ListedRobots } from './listed-robots.ts';

test('before the list has come, nothing is known of any robot', () => {
  const listed = new ListedRobots();
  expect(listed.lacks('a')).toBe(false);
  listed.take([]);
  expect(listed.lacks('a')).toBe(true);
});

test('a robot that was listed once is known, also when it has left', () => {
  const listed = new ListedRobots();
  listed.take([{ id: 'a', name: 'A' }]);
  listed.take([{ id: 'b', name: 'B' }]);
  expect(listed.lacks('a')).toBe(false);
  expect(listed.lacks('b')).toBe(false);
  expect(listed.lacks('c')).toBe(true);
});
