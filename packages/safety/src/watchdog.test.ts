import { expect, test } from 'vitest';
import { Watchdog } from './watchdog.ts';

test('is expired before it is first fed', () => {
  const watchdog = new Watchdog(150);
  expect(watchdog.expired(0)).toBe(true);
  expect(watchdog.deadlineMs).toBeNull();
});

test('expires exactly at its deadline', () => {
  const watchdog = new Watchdog(150);
  watchdog.feed(1000);
  expect(watchdog.deadlineMs).toBe(1150);
  expect(watchdog.expired(1149.999)).toBe(false);
  expect(watchdog.expired(1150)).toBe(true);
  watchdog.feed(1149);
  expect(watchdog.expired(1298)).toBe(false);
  expect(watchdog.expired(1299)).toBe(true);
});

test('after a reset it is as if it had never been fed', () => {
  const watchdog = new Watchdog(150);
  watchdog.feed(0);
  watchdog.reset();
  expect(watchdog.expired(1)).toBe(true);
  expect(watchdog.deadlineMs).toBeNull();
});

test('is expired at a time that is NaN', () => {
  const watchdog = new Watchdog(150);
  watchdog.feed(0);
  expect(watchdog.expired(Number.NaN)).toBe(true);
  watchdog.feed(Number.NaN);
  expect(watchdog.expired(0)).toBe(true);
});
