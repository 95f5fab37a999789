import { expect, test } from 'vitest';
import { CloudRate } from './cloud-rate.ts';

const taken = (rate: CloudRate, times: readonly number[]) => times.filter((ms) => rate.takes(ms));
const every = (ms: number, count: number) => Array.from({ length: count }, (_, k) => k * ms);

test('records as many per second as configured, evenly, whatever arrives', () => {
  expect(taken(new CloudRate(5), every(1000 / 30, 58))).toHaveLength(10);
  expect(taken(new CloudRate(10), every(100, 20))).toHaveLength(20);
  expect(taken(new CloudRate(Number.POSITIVE_INFINITY), every(1, 100))).toHaveLength(100);
});

test('records none at a rate of 0', () => {
  expect(taken(new CloudRate(0), every(100, 20))).toEqual([]);
});

test('records both formats of one capture, or neither', () => {
  expect(taken(new CloudRate(5), [0, 0, 33, 33, 200, 200])).toEqual([0, 0, 200, 200]);
});
