import { expect, it } from 'vitest';
import { type Forward, GivenUp } from './given-up.ts';

const forward = (cumulativeTsn: number, streams: [number, number][] = []): Forward => ({
  cumulativeTsn,
  streams,
});

it('is told again until the peer has acknowledged it, and not at every packet', () => {
  const givenUp = new GivenUp();
  expect(givenUp.due(5, 0)).toBeNull();
  const chunk = forward(9);
  givenUp.onTold(chunk, 1000);
  expect(givenUp.due(5, 1199)).toBe('wait');
  expect(givenUp.due(5, 1200)).toBe(chunk);
  expect(givenUp.due(5, 1201)).toBe('wait');
  expect(givenUp.due(9, 1202)).toBeNull();
  // Forgotten, not only silent.
  expect(givenUp.due(5, 9999)).toBeNull();
});

it('names the streams of all chunks that are not acknowledged, each with its latest number', () => {
  const givenUp = new GivenUp();
  givenUp.onTold(
    forward(9, [
      [1, 4],
      [2, 7],
    ]),
    0,
  );
  const second = forward(12, [[1, 5]]);
  givenUp.onTold(second, 10);
  expect(second.streams).toEqual([
    [1, 5],
    [2, 7],
  ]);
  expect(givenUp.due(12, 20)).toBeNull();
  const third = forward(15, [[3, 1]]);
  givenUp.onTold(third, 30);
  expect(third.streams).toEqual([[3, 1]]);
});

it('knows what is acknowledged where the numbers wrap', () => {
  const givenUp = new GivenUp();
  const chunk = forward(3);
  givenUp.onTold(chunk, 0);
  expect(givenUp.due(2 ** 32 - 2, 500)).toBe(chunk);
  expect(givenUp.due(4, 1000)).toBeNull();
});
