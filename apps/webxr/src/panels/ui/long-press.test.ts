import { beforeEach, expect, test } from 'vitest';
import { LONG_PRESS_MS, LongPress } from './long-press.ts';

let press: LongPress;
beforeEach(() => {
  press = new LongPress();
});

test('a finger that is held still points once', () => {
  expect([LONG_PRESS_MS, press.take()]).toEqual([500, null]);
  press.down(1, 100, 100);
  press.move(1, 106, 108);
  expect([press.waits, press.take(), press.waits, press.take()]).toEqual([true, 1, false, null]);
});

test('one that moves away does not, although it comes back', () => {
  press.down(1, 100, 100);
  press.move(1, 107, 108);
  press.move(1, 100, 100);
  expect(press.take()).toBeNull();
});

test('one that is let go does not, and the next one begins anew', () => {
  press.down(1, 100, 100);
  press.up(1);
  expect(press.take()).toBeNull();
  press.down(2, 0, 0);
  press.move(1, 900, 900);
  expect(press.take()).toBe(2);
});

test('two fingers do not, whichever is let go, before both are', () => {
  press.down(1, 100, 100);
  press.down(2, 200, 100);
  expect(press.take()).toBeNull();
  press.up(1);
  expect(press.take()).toBeNull();
  press.down(3, 100, 100);
  expect(press.take()).toBeNull();
  press.up(2);
  press.up(3);
  press.down(4, 100, 100);
  expect(press.take()).toBe(4);
});
