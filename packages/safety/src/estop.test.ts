import { expect, test } from 'vitest';
import { EstopLatch } from './estop.ts';

test('is clear at the start', () => {
  expect(new EstopLatch().meet(true)).toBe('clear');
});

test('stays latched, whatever is asked', () => {
  const estop = new EstopLatch();
  expect(estop.latch('operator')).toBe(true);
  expect(estop.latch('robot')).toBe(false);
  expect(estop.by).toBe('operator');
  expect(estop.meet(false)).toBe('latched');
});

test('only a release ends it', () => {
  const estop = new EstopLatch();
  expect(estop.release()).toBe(false);
  estop.latch('robot');
  expect(estop.release()).toBe(true);
  expect(estop.latched).toBe(false);
  expect(estop.release()).toBe(false);
});

test('a hand that holds on is refused until it says that it has let go', () => {
  const estop = new EstopLatch();
  estop.latch('operator');
  estop.release();
  for (let i = 0; i < 1000; i++) expect(estop.meet(true)).toBe('let-go');
  expect(estop.meet(false)).toBe('clear');
  expect(estop.meet(true)).toBe('clear');
});

test('what the hand did before the release does not count', () => {
  const estop = new EstopLatch();
  estop.latch('operator');
  expect(estop.meet(false)).toBe('latched');
  estop.release();
  expect(estop.meet(true)).toBe('let-go');
});

test('a new latch begins anew, and another hand is asked by itself', () => {
  const estop = new EstopLatch();
  estop.latch('operator');
  estop.release();
  estop.meet(false);
  estop.latch('operator');
  estop.release();
  expect(estop.meet(true)).toBe('let-go');
  estop.changeHand();
  expect(estop.meet(true)).toBe('clear');
});
