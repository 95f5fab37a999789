import { expect, test } from 'vitest';
import { StartProbes } from './start-probes.ts';

const MOST = 200e6;

/** The rates of the probe trains on a path with this rate, Mbit/s, and the rate that they find. */
function search(pathBitsPerSecond: number): { trains: number[]; found: number } {
  const probes = new StartProbes(3e6);
  const trains: number[] = [];
  let found = 0;
  for (let now = 0; now < 10_000; now += 100) {
    const rate = probes.due(MOST, now);
    if (rate === 0) continue;
    trains.push(Math.round(rate / 1e6));
    found = probes.onOutcome(rate, Math.min(rate, pathBitsPerSecond));
  }
  return { trains, found };
}

test('probes at three and six times the initial rate, then at twice the rate found', () => {
  const { trains, found } = search(40e6);
  expect(trains).toEqual([9, 18, 36, 72]);
  expect(found).toBe(0.95 * 40e6);
});

test('sends the second train whatever the first one found', () => {
  expect(search(4e6)).toEqual({ trains: [9, 18], found: 0.95 * 4e6 });
});

test('never exceeds the maximum rate', () => {
  expect(search(1e9).trains.at(-1)).toBe(200);
});

test('ends if a train is not answered for a second', () => {
  const probes = new StartProbes(3e6);
  expect(probes.due(MOST, 0)).toBe(9e6);
  expect(probes.due(MOST, 1001)).toBe(0);
  probes.onOutcome(9e6, 9e6);
  expect(probes.due(MOST, 1002)).toBe(0);
});

test('makes trains of 15 ms, with a minimum number of packets', () => {
  expect(StartProbes.bytes(80e6)).toBe(150_000);
  expect(StartProbes.bytes(1e6)).toBe(6000);
});
