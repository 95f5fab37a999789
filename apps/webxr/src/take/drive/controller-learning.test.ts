import { expect, test } from 'vitest';
import { Calibration, MovedAxis, PressedButton } from './controller-learning.ts';
import { EMPTY_MAP } from './controller-map.ts';

test('the axis that is moved and let go is recognised, and which way was meant', () => {
  const moved = new MovedAxis([0.05, 0, 1]);
  for (const y of [-0.3, -0.7, -1, -0.4]) expect(moved.see([0.2, y, 1])).toBe(null);
  expect(moved.see([0.05, -0.02, 1])).toMatchObject({ axis: 1, centre: 0, inverted: true });
  const pedal = new MovedAxis([0.05, 0, 1]);
  for (const gas of [0.4, -1]) expect(pedal.see([0, 0, gas])).toBe(null);
  expect(pedal.see([0, 0, 0.98])).toMatchObject({ axis: 2, centre: 1, inverted: true });
});

test('neither noise, a stick that stays pushed nor what is no number counts as moved', () => {
  const moved = new MovedAxis([0, 0]);
  for (const x of [0.2, -0.3, 0.1, 0]) expect(moved.see([x, Number.NaN])).toBe(null);
  for (let i = 0; i < 100; i++) expect(moved.see([0, 1])).toBe(null);
  expect(moved.see([0])).toMatchObject({ axis: 1 });
});

test('a button counts once it is pressed anew', () => {
  const button = (down: boolean) => ({ pressed: down, value: Number(down) });
  const run = new PressedButton([button(true), button(false)]);
  expect(run.see([button(true), button(false)])).toBe(null);
  expect(run.see([button(true), button(true)])).toBe(1);
  expect(run.see([button(false), button(false)])).toBe(null);
  expect(run.see([button(true), button(false)])).toBe(0);
});

test('measures rest and range, and says which axes did not move', () => {
  const axis = { axis: 0, centre: 0, least: -1, most: 1, inverted: false, deadZone: 0.1 };
  const map = {
    ...EMPTY_MAP,
    sticks: [{ forward: axis, back: null, left: { ...axis, axis: 3 } }],
    gripAxis: { ...axis, axis: 1 },
  };
  const run = new Calibration([0.1, 0, 0, 0]);
  for (const x of [0.1, -0.7, Number.NaN, 9]) run.see([x, 0.5, 0, 0.02]);
  const { map: measured, still } = run.finish(map);
  expect(measured.sticks[0]?.forward).toMatchObject({ centre: 0.1, least: -0.7, most: 1 });
  expect(measured.sticks[0]?.left).toEqual({ ...axis, axis: 3 });
  expect(measured.gripAxis).toMatchObject({ centre: 0, least: 0, most: 0.5 });
  expect(still).toEqual([3]);
});

test('an axis that moved by less than half, or is not back yet, was not meant', () => {
  const moved = new MovedAxis([0]);
  for (const x of [0.49, 0]) expect(moved.see([x])).toBe(null);
  for (const x of [0.51, 0.16]) expect(moved.see([x])).toBe(null);
  expect(moved.see([0.14])).toMatchObject({ axis: 0, inverted: false });
});
