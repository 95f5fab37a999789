import { expect, test } from 'vitest';
import { InFlight } from './in-flight.ts';

test('a packet is in flight until it, or a later one, is answered', () => {
  const flight = new InFlight();
  for (let i = 0; i < 10; i++) flight.onSent(i, 100, 0);
  flight.onAnswered(3);
  expect(flight.bytes).toBe(600);
  flight.onAnswered(1);
  expect(flight.bytes).toBe(600);
  flight.onAnswered(9);
  expect(flight.bytes).toBe(0);
});

test('sequence numbers wrap', () => {
  const flight = new InFlight();
  for (let i = 65_530; i < 65_545; i++) flight.onSent(i & 0xffff, 100, 0);
  flight.onAnswered(65_535);
  expect(flight.bytes).toBe(900);
  flight.onAnswered(8);
  expect(flight.bytes).toBe(0);
});

test('finds the probe cluster of a packet', () => {
  const flight = new InFlight();
  flight.onSent(7, 100, 3);
  flight.onSent(8, 100, 0);
  expect([flight.clusterOf(7), flight.clusterOf(8)]).toEqual([3, 0]);
});
