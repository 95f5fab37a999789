import { expect, test } from 'vitest';
import { EstopLatch } from './estop.ts';

test('is clear at first', () => {
  expect(new EstopLatch(150).meet(true, 0)).toBe('clear');
});

test('remembers who latched it first', () => {
  const estop = new EstopLatch(150);
  expect(estop.latch('robot')).toBe(true);
  expect(estop.latch('operator')).toBe(false);
  expect(estop.by).toBe('robot');
  expect(estop.meet(false, 1e6)).toBe('latched');
});

test('once it is released, a second release does nothing', () => {
  const estop = new EstopLatch(150);
  expect(estop.release(0)).toBe(false);
  estop.latch('operator');
  expect(estop.release(0)).toBe(true);
  expect(estop.latched).toBe(false);
  expect(estop.release(0)).toBe(false);
});

test('a stick that is held through the release does not start the robot', () => {
  const estop = new EstopLatch(150);
  estop.latch('operator');
  estop.release(1000);
  for (let t = 1010; t < 5000; t += 10) expect(estop.meet(true, t)).toBe('let-go');
});

test('a command for zero is letting go', () => {
  const estop = new EstopLatch(150);
  estop.latch('operator');
  estop.release(1000);
  expect(estop.meet(false, 1010)).toBe('clear');
  expect(estop.meet(true, 1020)).toBe('clear');
});

test('so is no request for motion for the given time', () => {
  const estop = new EstopLatch(150);
  estop.latch('operator');
  estop.release(1000);
  expect(estop.meet(true, 1149)).toBe('let-go');
  expect(estop.meet(true, 1298)).toBe('let-go');
  expect(estop.meet(true, 1448)).toBe('clear');
});

test('a second stop requires the hand to let go again', () => {
  const estop = new EstopLatch(150);
  estop.latch('operator');
  estop.release(0);
  estop.meet(false, 10);
  estop.latch('operator');
  estop.release(20);
  expect(estop.meet(true, 30)).toBe('let-go');
});
