import { expect, it } from 'vitest';
import { LossRequests } from './loss-requests.ts';

const options = { reorderMs: 5, againMs: 25, most: 2, uselessMs: 150 };

it('requests a missing packet once it can no longer have been overtaken, twice, and then no more', () => {
  const requests = new LossRequests(options);
  requests.onPacket(65_534, 0);
  requests.onPacket(1, 1);
  expect(requests.due(5)).toEqual([]);
  expect(requests.due(6)).toEqual([65_535, 0]);
  expect(requests.due(20)).toEqual([]);
  requests.onPacket(0, 21);
  expect(requests.recovered).toBe(1);
  expect(requests.due(31)).toEqual([65_535]);
  expect(requests.due(100)).toEqual([]);
  expect([requests.lost, requests.waiting]).toEqual([1, false]);
});

it('requests neither packets that arrive out of order nor those of a path that was down', () => {
  const requests = new LossRequests(options);
  for (const [sequence, at] of [
    [0, 0],
    [2, 1],
    [1, 2],
    [2, 3],
  ] as const)
    requests.onPacket(sequence, at);
  expect(requests.due(50)).toEqual([]);
  requests.onPacket(3000, 60);
  expect(requests.due(70).length).toBe(512);
  expect(requests.lost).toBe(2997 - 512);
});
