import { expect, test } from 'vitest';
import { EstopLatch } from './estop.ts';

// What a latched stop refuses, and which hand must open first: drive-guard.property, estop-holds and open-hand tests.

test('only a release ends it, and there is nothing to release before', () => {
  const estop = new EstopLatch();
  expect(estop.release()).toBe(false);
  expect([estop.latch('operator'), estop.latch('robot')]).toEqual([true, false]);
  expect([estop.release(), estop.latched, estop.release()]).toEqual([true, false, false]);
});
