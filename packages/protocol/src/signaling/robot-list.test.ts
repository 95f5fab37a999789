import { expect, test } from 'vitest';
import { applyRobotsChanged } from './robot-list.ts';

const a = { id: 'a', name: 'A' };
const b = { id: 'b', name: 'B' };

test('appends new robots, keeps the place of renamed ones, removes those that are gone', () => {
  const list = [a, b];
  const renamed = { id: 'a', name: 'Anna' };
  const c = { id: 'c', name: 'C' };
  expect(applyRobotsChanged(list, { here: [c, renamed], gone: [] })).toEqual([renamed, b, c]);
  expect(applyRobotsChanged(list, { here: [], gone: ['a'] })).toEqual([b]);
  expect(list).toEqual([a, b]);
});

test('known robots and unknown removals change nothing', () => {
  expect(applyRobotsChanged([a], { here: [a], gone: ['x'] })).toEqual([a]);
});
