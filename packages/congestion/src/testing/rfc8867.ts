/**
 * Scenarios after the test cases of RFC 8867 ("Test Cases for Evaluating Congestion Control for Interactive Real-Time
 * Media"): 50 ms of propagation each way and a queue of 300 ms unless the case says otherwise. Cases 5.5 and 5.7 are
 * shortened from 300 s.
 */
import type { CapacityStep } from '@farpoint/network-sim';
import type { Scenario } from './scenario.ts';

const BASE = { rttMs: 100, queueMs: 300 };

const steps = (reference: number, ...pairs: (readonly [number, number])[]): CapacityStep[] =>
  pairs.map(([seconds, ratio]) => ({ atMs: seconds * 1000, mbps: ratio * reference }));

/** §5.1: one flow; 1 Mbit/s at ratios 1.0, 2.5, 0.6, 1.0. */
export const VARIABLE_CAPACITY: Scenario = {
  ...BASE,
  name: 'RFC 8867 5.1 variable capacity',
  durationMs: 100_000,
  capacity: steps(1, [0, 1], [40, 2.5], [60, 0.6], [80, 1]),
};

/** §5.2: two flows; 2 Mbit/s at ratios 2.0, 1.0, 1.75, 0.5, 1.0. */
export const VARIABLE_CAPACITY_TWO_FLOWS: Scenario = {
  ...BASE,
  name: 'RFC 8867 5.2 variable capacity, two flows',
  durationMs: 125_000,
  capacity: steps(2, [0, 2], [25, 1], [50, 1.75], [75, 0.5], [100, 1]),
  media: [{}, {}],
};

/** §5.3: the feedback path is narrow and also carries a TCP flow. */
export const CONGESTED_FEEDBACK: Scenario = {
  ...BASE,
  name: 'RFC 8867 5.3 congested feedback link',
  durationMs: 60_000,
  capacity: steps(4, [0, 1]),
  backCapacity: steps(2, [0, 1], [20, 0.5], [40, 1]),
  backQueueMs: 300,
  cubic: [{ startMs: 5000, stopMs: 50_000, reverse: true }],
};

/** §5.4: three flows that begin 20 s apart, 3.5 Mbit/s. */
export const COMPETING_MEDIA: Scenario = {
  ...BASE,
  name: 'RFC 8867 5.4 competing media flows',
  durationMs: 120_000,
  capacity: steps(3.5, [0, 1]),
  media: [{}, { startMs: 20_000 }, { startMs: 40_000 }],
};

/** §5.5: five flows with one-way delays of 10, 25, 50, 100 and 150 ms, 10 s apart, 4 Mbit/s. */
export const ROUND_TRIP_FAIRNESS: Scenario = {
  ...BASE,
  name: 'RFC 8867 5.5 round-trip fairness',
  durationMs: 180_000,
  capacity: steps(4, [0, 1]),
  media: [20, 50, 100, 200, 300].map((rttMs, i) => ({ rttMs, startMs: i * 10_000 })),
};

/** §5.6: one flow and one long TCP flow, 2 Mbit/s. */
export const LONG_TCP: Scenario = {
  ...BASE,
  name: 'RFC 8867 5.6 long TCP flow',
  durationMs: 120_000,
  capacity: steps(2, [0, 1]),
  media: [{ startMs: 5000 }],
  cubic: [{}],
};

/** §5.7: two flows, and short TCP flows of 100–1,000 kB that come and go, 2 Mbit/s. */
export const SHORT_TCP: Scenario = {
  ...BASE,
  name: 'RFC 8867 5.7 short TCP flows',
  durationMs: 120_000,
  capacity: steps(2, [0, 1]),
  media: [{}, {}],
  cubic: Array.from({ length: 10 }, (_, i) => ({
    startMs: 10_000 + i * 9000 + ((i * 3791) % 4000),
    bytes: 100_000 + ((i * 337) % 900) * 1000,
  })),
};

/** §5.8: three flows, one of which pauses from 40 s to 60 s, 3.5 Mbit/s. */
export const PAUSE_RESUME: Scenario = {
  ...BASE,
  name: 'RFC 8867 5.8 pause and resume',
  durationMs: 120_000,
  capacity: steps(3.5, [0, 1]),
  media: [{}, { pauses: [[40_000, 60_000]] }, {}],
};
