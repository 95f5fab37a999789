import { beforeEach, expect, it } from 'vitest';
import { AIM_MS, HeldAim } from './held-aim.ts';

const there = { x: 1, y: 2 };
const [left, right] = [0, 1];
let aim: HeldAim;
beforeEach(() => {
  aim = new HeldAim();
});

it('names the place at which the trigger was held, when it is let go of', () => {
  aim.pull(right, 0);
  aim.point({ x: 9, y: 9 }, 10);
  expect(aim.isReady(AIM_MS)).toBe(false);
  aim.point(there, AIM_MS + 10);
  expect(aim.isReady(AIM_MS + 10)).toBe(true);
  expect(aim.letGo(right, AIM_MS + 20)).toEqual({ kind: 'goal', place: there });
  expect(aim.hand).toBe(null);
});

it('names none after a short pull: that is a click', () => {
  aim.pull(right, 0);
  aim.point(there, 0);
  expect(aim.letGo(right, 300)).toEqual({ kind: 'click' });
  aim.pull(right, 1000);
  aim.point(there, 1100);
  expect(aim.letGo(right, 1000 + AIM_MS)).toEqual({ kind: 'nothing' });
});

it('names none if it points away from the floor, and waits anew when it points there again', () => {
  aim.pull(right, 0);
  aim.point(there, 0);
  aim.point(null, AIM_MS);
  aim.point(there, AIM_MS + 50);
  expect(aim.letGo(right, AIM_MS + 60)).toEqual({ kind: 'nothing' });
});

it('names none once it was cancelled, whatever the trigger does until it is pulled anew', () => {
  aim.pull(right, 0);
  aim.point(there, 0);
  aim.cancel();
  aim.point(there, 10);
  expect(aim.place).toBe(null);
  expect(aim.letGo(right, 2000)).toEqual({ kind: 'nothing' });
});

it('follows one hand', () => {
  aim.pull(right, 0);
  aim.point(there, 0);
  aim.pull(left, 100);
  expect(aim.letGo(left, AIM_MS + 100)).toEqual({ kind: 'nothing' });
  expect(aim.letGo(right, AIM_MS + 100)).toEqual({ kind: 'goal', place: there });
});
