/**
 * RFC 8867 defines test cases but no pass marks. Ours: use the link, keep the queue short if nobody else fills it,
 * share fairly with flows of the same kind, and neither starve beside TCP nor starve it.
 */
import { describe, expect, test } from 'vitest';
import { AdaptiveRateController } from '../adaptive-rate-controller.ts';
import { losses, msAboveQueue, queueQuantiles, throughput } from './measures.ts';
import {
  COMPETING_MEDIA,
  CONGESTED_FEEDBACK,
  LONG_TCP,
  PAUSE_RESUME,
  ROUND_TRIP_FAIRNESS,
  SHORT_TCP,
  VARIABLE_CAPACITY,
  VARIABLE_CAPACITY_TWO_FLOWS,
} from './rfc8867.ts';
import { type Outcome, runScenario, type Scenario } from './scenario.ts';

const run = (scenario: Scenario): Outcome =>
  runScenario(scenario, () => new AdaptiveRateController({ startBitsPerSecond: 1e6 }));

/** Mbit/s of each media flow between two times, s. */
const rates = (outcome: Outcome, from: number, to: number): number[] =>
  outcome.media.map((flow) => throughput(flow, from * 1000, to * 1000) / 1e6);

const sum = (values: number[]): number => values.reduce((a, b) => a + b, 0);

/** Jain's index: 1 for equal shares, 1/n where one has all. */
const fairness = (values: number[]): number =>
  sum(values) ** 2 / (values.length * sum(values.map((v) => v * v)));

const queue95 = (outcome: Outcome, from: number, to: number, flow = 0): number =>
  queueQuantiles(outcome.media[flow]!, from * 1000, to * 1000, [0.95])[0]!;

test('5.1 variable capacity', () => {
  const outcome = run(VARIABLE_CAPACITY);
  for (const [from, to, capacity] of [
    [5, 40, 1],
    [45, 60, 2.5],
    [65, 80, 0.6],
    [85, 100, 1],
  ] as const) {
    const used = sum(rates(outcome, from, to)) / capacity;
    expect(used, `${from} s`).toBeGreaterThan(0.8);
    // A single packet takes 17 ms at 0.6 Mbit/s.
    expect(queue95(outcome, from, to), `${from} s`).toBeLessThan(150);
  }
  expect(msAboveQueue(outcome.media[0]!, 100, 60_000, 80_000)).toBeLessThan(2000);
});

test('5.2 variable capacity with two flows', () => {
  const outcome = run(VARIABLE_CAPACITY_TWO_FLOWS);
  for (const [from, to, capacity] of [
    [5, 25, 4],
    [30, 50, 2],
    [55, 75, 3.5],
    [80, 100, 1],
    [105, 125, 2],
  ] as const) {
    const got = rates(outcome, from, to);
    expect(sum(got) / capacity, `${from} s`).toBeGreaterThan(0.75);
    expect(fairness(got), `${from} s`).toBeGreaterThan(0.85);
    expect(queue95(outcome, from, to), `${from} s`).toBeLessThan(100);
  }
});

test('5.3 congested feedback link', () => {
  const outcome = run(CONGESTED_FEEDBACK);
  expect(sum(rates(outcome, 10, 40)) / 4).toBeGreaterThan(0.3);
  expect(sum(rates(outcome, 50, 60)) / 4).toBeGreaterThan(0.85);
  expect(queue95(outcome, 5, 60)).toBeLessThan(60);
});

test('5.4 competing media flows', () => {
  const outcome = run(COMPETING_MEDIA);
  for (const [from, to, flows] of [
    [5, 20, 1],
    [28, 40, 2],
    [60, 120, 3],
  ] as const) {
    const got = rates(outcome, from, to).slice(0, flows);
    expect(sum(got) / 3.5, `${flows} flows`).toBeGreaterThan(0.85);
    expect(fairness(got), `${flows} flows`).toBeGreaterThan(0.9);
  }
  expect(queue95(outcome, 5, 120)).toBeLessThan(60);
});

test('5.5 round-trip fairness', () => {
  const outcome = run(ROUND_TRIP_FAIRNESS);
  const got = rates(outcome, 60, 180);
  expect(sum(got) / 4).toBeGreaterThan(0.8);
  expect(fairness(got)).toBeGreaterThan(0.75);
  expect(Math.min(...got)).toBeGreaterThan(0.5 * (4 / 5));
});

test('5.6 long TCP flow', () => {
  const outcome = run(LONG_TCP);
  const [ours] = rates(outcome, 15, 120) as [number];
  const theirs = throughput(outcome.cubic[0]!, 15_000, 120_000) / 1e6;
  expect(ours / (ours + theirs)).toBeGreaterThan(0.25);
  expect(ours / (ours + theirs)).toBeLessThan(0.75);
});

test('5.7 short TCP flows', () => {
  const outcome = run(SHORT_TCP);
  const got = rates(outcome, 10, 120);
  expect(Math.min(...got)).toBeGreaterThan(0.25);
  expect(fairness(got)).toBeGreaterThan(0.85);
  // Every transfer completes.
  for (const [i, flow] of outcome.cubic.entries()) {
    const bytes = sum(flow.arrivedBytes);
    expect(bytes, flow.name).toBeGreaterThanOrEqual(SHORT_TCP.cubic![i]!.bytes! * 0.99);
  }
  for (const flow of outcome.media) expect(losses(flow, 0, 120_000).overflow).toBeLessThan(0.05);
});

describe('5.8 pause and resume', () => {
  const outcome = run(PAUSE_RESUME);
  test('the others use what the paused flow leaves', () => {
    const [first, , third] = rates(outcome, 45, 60) as [number, number, number];
    expect((first + third) / 3.5).toBeGreaterThan(0.85);
  });
  test('it recovers its share within 10 s', () => {
    const got = rates(outcome, 70, 120);
    expect(sum(got) / 3.5).toBeGreaterThan(0.85);
    expect(fairness(got)).toBeGreaterThan(0.9);
    expect(queue95(outcome, 60, 120, 1)).toBeLessThan(60);
  });
});
