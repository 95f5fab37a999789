import { expect, test } from 'vitest';
import { casesOf, longProperty, someOf } from './cases.ts';

test('a share of the cases is tried, and never none', () => {
  expect([casesOf(600, 1), casesOf(600, 0.25), casesOf(5, 0.25), casesOf(1, 0.25)]).toEqual([600, 150, 2, 1]);
});

test('of a list, every fourth is tried, from any beginning, and all where all are', () => {
  const list = ['a', 'b', 'c', 'd', 'e', 'f'];
  expect([someOf(list, 0, 0.25), someOf(list, 3, 0.25), someOf(list, 1, 1)]).toEqual([
    ['a', 'e'],
    ['b', 'f'],
    list,
  ]);
  expect(someOf(['a'], 1, 0.25)).toEqual(['a']);
});

test('another seed gives other cases of every long property', () => {
  expect(longProperty(19, 600, { share: 1, propertySeed: 1 })).toEqual({ seed: 19, numRuns: 600 });
  expect(longProperty(19, 600, { share: 0.25, propertySeed: 4 })).toEqual({ seed: 22, numRuns: 150 });
});
