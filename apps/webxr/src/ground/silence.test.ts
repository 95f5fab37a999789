import { expect, test } from 'vitest';
import { arePointsHeard, silenceOf } from './silence.ts';

test('within half of a second of silence no figure is live, and within a second the connection is lost', () => {
  expect(silenceOf(0)).toBe('heard');
  // A report that is late, on a link that is jittery.
  expect(silenceOf(399)).toBe('heard');
  expect(silenceOf(400)).toBe('unheard');
  expect(silenceOf(699)).toBe('unheard');
  expect(silenceOf(700)).toBe('lost');
  expect(silenceOf(Number.NaN)).toBe('heard');
});

test('points of a slow stream may come as seldom as its frames', () => {
  expect(arePointsHeard(399, 10)).toBe(true);
  expect(arePointsHeard(400, 10)).toBe(false);
  expect(arePointsHeard(700, 2)).toBe(true);
  expect(arePointsHeard(750, 2)).toBe(false);
  expect(arePointsHeard(400, 0)).toBe(false);
});
