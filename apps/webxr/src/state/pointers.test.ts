import type { Operators } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { Pointers, pointingBar } from './pointers.ts';

const at = { x: 1, y: 2, z: 0 };
const operators: Operators = {
  type: 'operators',
  operators: [
    { number: 1, name: 'Ada', role: 'drive', drives: false, you: true },
    { number: 2, name: 'Bob', role: 'drive', drives: true, you: false },
  ],
};
const names = (pointers: Pointers, nowMs: number) => pointers.shown(operators, nowMs).map(({ name }) => name);

test('shows for five seconds who points, by the name in the list', () => {
  const pointers = new Pointers();
  expect(pointers.shown(null, 0)).toEqual([]);
  pointers.take(2, at, 0);
  pointers.take(7, at, 1000);
  pointers.own(at, 2000);
  expect(names(pointers, 4999)).toEqual(['Bob', 'Somebody', 'You']);
  expect(names(pointers, 5000)).toEqual(['Somebody', 'You']);
  expect(names(pointers, 7000)).toEqual([]);
});

test('says why nobody sees it: the robot, the grant, or that nobody else is there', () => {
  const alone = { ...operators, operators: operators.operators.filter(({ you }) => you) };
  expect(pointingBar({ mayPoint: null, operators })).toBe('notPassedOn');
  expect(pointingBar({ mayPoint: false, operators })).toBe('notPermitted');
  expect(pointingBar({ mayPoint: true, operators: alone })).toBe('alone');
  expect(pointingBar({ mayPoint: true, operators })).toBeNull();
  expect(pointingBar({ mayPoint: true, operators: null })).toBeNull();
});

test('has one spot of each operator, the last', () => {
  const pointers = new Pointers();
  pointers.take(2, at, 0);
  pointers.take(2, { x: 9, y: 9, z: 1 }, 4000);
  expect(pointers.shown(operators, 8000)).toEqual([{ by: 2, name: 'Bob', at: { x: 9, y: 9, z: 1 } }]);
  pointers.clear();
  expect(pointers.shown(operators, 8000)).toEqual([]);
});

test('shows only so many, the latest', () => {
  const pointers = new Pointers();
  for (let by = 1; by <= 1000; by++) pointers.take(by, at, 0);
  const shown = pointers.shown(null, 1).map(({ by }) => by);
  expect(shown).toHaveLength(16);
  expect(shown.at(-1)).toBe(1000);
});
