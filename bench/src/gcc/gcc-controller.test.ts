import {
  msAboveQueue,
  queueQuantiles,
  runScenario,
  type Scenario,
  utilisation,
} from '@farpoint/congestion/testing';
import { describe, expect, test } from 'vitest';
import { GccController } from './gcc-controller.ts';

const SCENARIO: Scenario = {
  name: 'steady',
  durationMs: 15_000,
  capacity: [{ atMs: 0, mbps: 20 }],
  rttMs: 42.4,
};

function run(more: Partial<Scenario> = {}) {
  const outcome = runScenario({ ...SCENARIO, ...more }, () => new GccController());
  const [flow] = outcome.media as [(typeof outcome.media)[0]];
  return { outcome, flow, used: (from: number, to: number) => utilisation(outcome, flow, from, to) };
}

describe('on simulated links, like libwebrtc’s', () => {
  test('finds a steady link within a second and stays just below it', () => {
    const { flow, used } = run();
    expect(used(1000, 3000)).toBeGreaterThan(0.7);
    expect(used(5000, 15_000)).toBeGreaterThan(0.75);
    expect(queueQuantiles(flow, 5000, 15_000, [0.95])[0]).toBeLessThan(10);
  });

  test('follows a falling capacity, and drains the queue', () => {
    const capacity = [...SCENARIO.capacity, { atMs: 8000, mbps: 5 }];
    const { flow, used } = run({ capacity });
    expect(msAboveQueue(flow, 100, 8000, 15_000)).toBeLessThan(2500);
    expect(queueQuantiles(flow, 12_000, 15_000, [0.5])[0]).toBeLessThan(20);
    expect(used(12_000, 15_000)).toBeGreaterThan(0.5);
  });

  test('tolerates 5 % loss, and yields to 20 %', () => {
    expect(run({ loss: 0.05 }).used(5000, 15_000)).toBeGreaterThan(0.5);
    expect(run({ loss: 0.2 }).used(10_000, 15_000)).toBeLessThan(0.05);
  });

  test('does not mistake jitter for congestion', () => {
    expect(run({ tailMs: 3 }).used(5000, 15_000)).toBeGreaterThan(0.6);
  });

  test('starts again after an outage', () => {
    const capacity = [...SCENARIO.capacity, { atMs: 5000, mbps: 0 }, { atMs: 8000, mbps: 20 }];
    expect(run({ capacity }).used(10_000, 15_000)).toBeGreaterThan(0.5);
  });
});

test('obeys the receiver’s limit', () => {
  const controller = new GccController({ startBitsPerSecond: 3e6 });
  controller.onReceiverLimit(1e6, 0);
  expect(controller.decision(0).targetBitsPerSecond).toBe(1e6);
});
