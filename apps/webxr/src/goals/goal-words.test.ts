import { expect, test } from 'vitest';
import { distanceWords, goalWords } from './goal-words.ts';

const place = { x: 1, y: 2 };

test.each([
  ['driving', null, 3.21, 'Going, 3.2 m'],
  ['driving', null, null, 'Going'],
  ['reached', null, 0.1, 'Arrived'],
  ['cancelled', 'stick', 1, 'Cancelled: you took the stick'],
  ['blocked', 'obstacle', 1, 'Stopped: something is in the way'],
  ['refused', 'too-far', 30, 'Not going: it is too far away'],
] as const)('%s, %s', (state, reason, metres, words) => {
  const status = { place, state, reason };
  expect(goalWords(status).text + distanceWords(status, metres)).toBe(words);
});
