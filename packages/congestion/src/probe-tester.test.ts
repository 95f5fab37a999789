import { expect, test } from 'vitest';
import { InFlight } from './in-flight.ts';
import { ProbeTester } from './probe-tester.ts';

/** A train at 10 Mbit/s, 1 ms per packet, whose arrival takes `spread` times as long. */
function outcomeOf(spread: number) {
  const flight = new InFlight();
  const tester = new ProbeTester();
  tester.ask(10e6, 12_500, 0);
  const cluster = tester.wish!.clusterId;
  const results = [];
  for (let i = 0; i < 14; i++) {
    const inTrain = i >= 2 && i < 12;
    flight.onSent(i, 1250, inTrain ? cluster : 0);
    tester.onSent(1250, inTrain ? cluster : 0, i);
    results.push({ transportSequence: i, bytes: 1250, sentMs: i, arrivalUs: (30 + i * spread) * 1000 });
  }
  expect(tester.wish).toBeNull();
  return {
    tester,
    first: tester.onFeedback(results.slice(0, 8), flight),
    outcome: tester.onFeedback(results.slice(8), flight),
  };
}

test('a train that passes unhindered arrives at its own rate', () => {
  const { first, outcome } = outcomeOf(1);
  expect(first).toBeNull();
  expect(outcome?.sentBitsPerSecond).toBeCloseTo(10e6);
  expect(outcome?.arrivedBitsPerSecond).toBeCloseTo(10e6);
});

test('a train that is spread out shows the rate of the link', () => {
  expect(outcomeOf(2).outcome?.arrivedBitsPerSecond).toBeCloseTo(5e6);
});

test('a train that nobody sends is given up', () => {
  const tester = new ProbeTester();
  tester.ask(10e6, 12_500, 0);
  expect(tester.expire(300, 50)).toBe(false);
  expect(tester.busy).toBe(true);
  expect(tester.expire(600, 50)).toBe(true);
  expect(tester.busy).toBe(false);
});
