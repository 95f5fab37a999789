import { expect, test } from 'vitest';
import { applyRobotsChanged } from './robot-list.ts';

const a = { id: 'a', name: 'A' };
const b = { id: 'b', name: 'B' };

test('who is new comes last, who is renamed keeps its place, who is gone is gone', () => {
  const list = [a, b];
  const renamed = { id: 'a', name: 'Anna' };
  const c = { id: 'c', name: 'C' };
  expect(applyRobotsChanged(list, { here: [c, renamed], gone: [] })).toEqual([renamed, b, c]);
  expect(applyRobotsChanged(list, { here: [], gone: ['a'] })).toEqual([b]);
  expect(list).toEqual([a, b]);
});

test('what is known already and what was never there change nothing', () => {
  expect(applyRobotsChanged([a], { here: [a], gone: ['x'] })).toEqual([a]);
});
