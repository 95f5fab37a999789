import { beforeEach, expect, test } from 'vitest';
import { type AimReading, FloorAim } from './floor-aim.ts';

const open: AimReading = { grip: 'open', barred: false, drives: false };
const held: AimReading = { ...open, grip: 'held' };
const away: AimReading = { ...open, grip: 'away' };

let aim: FloorAim;
beforeEach(() => {
  aim = new FloorAim();
  aim.update(open, 0);
});

test('a grip that is held aims, and points once when it opens, also while the other hand drives', () => {
  for (const drives of [false, true]) {
    expect(aim.update({ ...held, drives }, 1000)).toBe(false);
    expect(aim.by).toBe('grip');
    expect(aim.update({ ...held, drives }, 1250)).toBe(false);
    expect(aim.update({ ...open, drives }, 1250)).toBe(true);
    expect(aim.by).toBeNull();
    expect(aim.update({ ...open, drives }, 1260)).toBe(false);
  }
});

test('a hand that only closes for a moment points at nothing', () => {
  aim.update(held, 1000);
  expect(aim.update(open, 1249)).toBe(false);
});

test('a grip that is lost from sight does not point, nor does one that comes back held', () => {
  aim.update(held, 1000);
  expect(aim.update(away, 2000)).toBe(false);
  expect(aim.by).toBeNull();
  aim.update(held, 3000);
  expect(aim.by).toBeNull();
  expect(aim.update(open, 4000)).toBe(false);
  // One that was held from the beginning neither.
  const fresh = new FloorAim();
  fresh.update(held, 0);
  expect(fresh.by).toBeNull();
});

test('what bars it ends it, and the grip must open first', () => {
  aim.update(held, 1000);
  expect(aim.update({ ...held, barred: true }, 2000)).toBe(false);
  expect(aim.by).toBeNull();
  aim.update(held, 2100);
  expect(aim.by).toBeNull();
  expect(aim.update(open, 3000)).toBe(false);
  aim.update(held, 4000);
  expect(aim.update({ ...open, barred: true }, 5000)).toBe(false);
});

test('after the menu’s entry one trigger points, once, for a while, and not while a hand drives', () => {
  expect(aim.take()).toBe(false);
  aim.arm(1000);
  aim.update(open, 15_999);
  expect([aim.by, aim.take(), aim.by, aim.take()]).toEqual(['trigger', true, null, false]);
  aim.arm(1000);
  aim.update(away, 16_000);
  expect(aim.take()).toBe(false);
  aim.arm(1000);
  aim.update({ ...open, drives: true }, 1100);
  expect(aim.take()).toBe(false);
  aim.arm(1000);
  aim.update({ ...open, barred: true }, 1100);
  expect(aim.take()).toBe(false);
  // A grip takes its place.
  aim.arm(1000);
  aim.update(held, 1100);
  expect([aim.by, aim.take()]).toEqual(['grip', false]);
});
