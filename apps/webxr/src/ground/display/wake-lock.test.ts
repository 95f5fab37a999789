import { expect, test } from 'vitest';
import { type ScreenLock, WakeLock } from './wake-lock.ts';

class Lock implements ScreenLock {
  released = 0;
  #listener: () => void = () => {};
  async release() {
    this.released++;
    this.#listener();
  }
  addEventListener(_: 'release', listener: () => void) {
    this.#listener = listener;
  }
}

function setup() {
  const given: Lock[] = [];
  const lock = new WakeLock(async () => {
    const next = new Lock();
    given.push(next);
    return next;
  });
  return { given, lock };
}

test('the screen stays on while it is wanted', async () => {
  const { given, lock } = setup();
  lock.want(true);
  await lock.settle();
  await lock.settle();
  expect(given).toHaveLength(1);
  expect(lock.held).toBe(true);
  lock.want(false);
  await lock.settle();
  expect(given[0]?.released).toBe(1);
  expect(lock.held).toBe(false);
});

test('what the browser took away is asked for again', async () => {
  const { given, lock } = setup();
  lock.want(true);
  await lock.settle();
  await given[0]?.release();
  expect(lock.held).toBe(false);
  await lock.settle();
  expect(given).toHaveLength(2);
  expect(lock.held).toBe(true);
});

test('given up while it is asked for, it is given back', async () => {
  let give: (lock: Lock) => void = () => {};
  const lock = new WakeLock(
    () =>
      new Promise((resolve) => {
        give = resolve;
      }),
  );
  lock.want(true);
  lock.want(false);
  const late = new Lock();
  give(late);
  await Promise.resolve();
  await Promise.resolve();
  await Promise.resolve();
  expect(late.released).toBe(1);
  expect(lock.held).toBe(false);
});

test('a browser that refuses or has none is no fault', async () => {
  const refusing = new WakeLock(() => Promise.reject(new Error('low battery')));
  refusing.want(true);
  await refusing.settle();
  expect(refusing.held).toBe(false);
  const none = new WakeLock(null);
  none.want(true);
  await none.settle();
  expect(none.held).toBe(false);
});
