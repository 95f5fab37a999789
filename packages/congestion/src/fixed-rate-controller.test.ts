import type { PacketResult } from '@farpoint/rtp';
import fc from 'fast-check';
import { beforeEach, describe, expect, test } from 'vitest';
import { FixedRateController } from './fixed-rate-controller.ts';

const MBIT = 1_000_000;

let controller: FixedRateController;
beforeEach(() => {
  controller = new FixedRateController({ bitsPerSecond: 40 * MBIT });
});

function results(received: number, lost: number): PacketResult[] {
  return Array.from({ length: received + lost }, (_, i) => ({
    transportSequence: i,
    bytes: 1244,
    sentMs: 0,
    arrivalUs: i < received ? i * 1000 : null,
  }));
}

/** Sends for `seconds` with feedback every 50 ms that reports this loss. @returns the end time */
function run(fromMs: number, seconds: number, loss: number): number {
  const untilMs = fromMs + seconds * 1000;
  for (let t = fromMs; t < untilMs; t += 50) {
    for (let i = 0; i < 50; i++) controller.onPacketSent(i, 1244, t);
    controller.onFeedback(results(Math.round(50 * (1 - loss)), Math.round(50 * loss)), t);
  }
  controller.update(untilMs);
  return untilMs;
}

test('gives the configured rate', () => {
  expect(controller.targetBitsPerSecond(0)).toBe(40 * MBIT);
  run(0, 10, 0);
  expect(controller.targetBitsPerSecond(0)).toBe(40 * MBIT);
});

test('loss for a whole second halves the rate, a short burst of loss does not', () => {
  let t = run(0, 0.95, 0);
  t = run(t, 0.05, 1);
  expect(controller.targetBitsPerSecond(t)).toBe(40 * MBIT);
  run(t, 1, 0.2);
  expect(controller.targetBitsPerSecond(t)).toBe(20 * MBIT);
});

test('between clean and sustained loss, the rate stays', () => {
  let t = run(0, 1, 0.5);
  t = run(t, 5, 0.06);
  expect(controller.targetBitsPerSecond(t)).toBe(20 * MBIT);
});

test('recovers in clean seconds, up to the configured rate and no further', () => {
  let t = run(0, 1, 0.5);
  t = run(t, 1, 0);
  expect(controller.targetBitsPerSecond(t)).toBeCloseTo(24 * MBIT, 3);
  t = run(t, 3, 0);
  expect(controller.targetBitsPerSecond(t)).toBe(40 * MBIT);
});

test('loss never lowers the rate below the floor; a floor above the rate is the rate', () => {
  controller = new FixedRateController({ bitsPerSecond: 40 * MBIT, floorBitsPerSecond: 3 * MBIT });
  run(0, 10, 0.9);
  expect(controller.targetBitsPerSecond(0)).toBe(3 * MBIT);
  controller = new FixedRateController({ bitsPerSecond: 0.5 * MBIT });
  run(0, 10, 0.9);
  expect(controller.targetBitsPerSecond(0)).toBe(0.5 * MBIT);
});

test('the receiver’s limit applies, also below the floor, until it is lifted', () => {
  controller.onReceiverLimit(0.2 * MBIT, 0);
  expect(controller.targetBitsPerSecond(0)).toBe(0.2 * MBIT);
  controller.onReceiverLimit(100 * MBIT, 0);
  expect(controller.targetBitsPerSecond(0)).toBe(40 * MBIT);
  controller.onReceiverLimit(-1, 0);
  expect(controller.targetBitsPerSecond(0)).toBe(0);
});

describe('without transport-wide feedback', () => {
  test('detects loss from the receiver’s sums', () => {
    for (let t = 0; t <= 1000; t += 200) {
      controller.onPacketSent(0, 1244, t);
      controller.onReceiverReport({ packetsReceived: t, packetsLost: t / 4 }, t);
    }
    expect(controller.targetBitsPerSecond(0)).toBe(20 * MBIT);
  });

  test('judges each interval’s sums by themselves', () => {
    controller.onPacketSent(0, 1244, 0);
    for (let t = 0; t <= 6000; t += 200) {
      controller.onReceiverReport({ packetsReceived: t, packetsLost: Math.min(t, 1000) / 4 }, t);
    }
    expect(controller.targetBitsPerSecond(0)).toBe(40 * MBIT);
  });

  test('ignores a report that was overtaken', () => {
    controller.onPacketSent(0, 1244, 0);
    controller.onReceiverReport({ packetsReceived: 1000, packetsLost: 100 }, 0);
    controller.onReceiverReport({ packetsReceived: 2000, packetsLost: 100 }, 400);
    controller.onReceiverReport({ packetsReceived: 1100, packetsLost: 900 }, 1000);
    controller.update(1001);
    expect(controller.targetBitsPerSecond(0)).toBe(40 * MBIT);
  });

  test('prefers transport-wide feedback to the sums', () => {
    controller.onPacketSent(0, 1244, 0);
    controller.onReceiverReport({ packetsReceived: 0, packetsLost: 0 }, 0);
    controller.onFeedback(results(100, 0), 500);
    controller.onReceiverReport({ packetsReceived: 100, packetsLost: 900 }, 1000);
    expect(controller.targetBitsPerSecond(0)).toBe(40 * MBIT);
  });
});

describe('silence', () => {
  test('of a receiver that has answered before counts as loss', () => {
    let t = run(0, 1, 0);
    for (const end = t + 1000; t < end; t += 10) controller.onPacketSent(0, 1244, t);
    controller.update(t);
    expect(controller.targetBitsPerSecond(t)).toBe(20 * MBIT);
  });

  test('of a receiver that never answered, or while nothing is sent, means nothing', () => {
    for (let t = 0; t < 3000; t += 10) {
      controller.onPacketSent(0, 1244, t);
      controller.update(t);
    }
    expect(controller.targetBitsPerSecond(0)).toBe(40 * MBIT);
    const t = run(3000, 2, 0);
    for (let later = t; later < t + 10_000; later += 25) controller.update(later);
    expect(controller.targetBitsPerSecond(0)).toBe(40 * MBIT);
  });
});

test('ignores the loss fraction of few packets', () => {
  controller.onPacketSent(0, 1244, 0);
  controller.onFeedback(results(5, 5), 500);
  controller.update(1000);
  expect(controller.targetBitsPerSecond(0)).toBe(40 * MBIT);
});

test('stays between floor and configured rate, never above the receiver’s limit, whatever is reported', () => {
  const event = fc.oneof(
    fc.record({ kind: fc.constant('feedback' as const), received: fc.nat(60), lost: fc.nat(60) }),
    fc.record({ kind: fc.constant('report' as const), received: fc.nat(100_000), lost: fc.nat(100_000) }),
    fc.record({
      kind: fc.constant('limit' as const),
      received: fc.integer({ min: -5, max: 80 * MBIT }),
      lost: fc.nat(0),
    }),
    fc.record({ kind: fc.constant('sent' as const), received: fc.nat(60), lost: fc.nat(0) }),
  );
  fc.assert(
    fc.property(fc.array(fc.tuple(fc.nat(1500), event), { maxLength: 100, size: 'max' }), (events) => {
      controller = new FixedRateController({ bitsPerSecond: 40 * MBIT });
      let t = 0;
      let limit = Number.POSITIVE_INFINITY;
      for (const [dt, { kind, received, lost }] of events) {
        t += dt;
        if (kind === 'feedback') controller.onFeedback(results(received, lost), t);
        else if (kind === 'report')
          controller.onReceiverReport({ packetsReceived: received, packetsLost: lost }, t);
        else if (kind === 'sent') for (let i = 0; i < received; i++) controller.onPacketSent(i, 1244, t);
        else {
          controller.onReceiverLimit(received, t);
          limit = Math.max(received, 0);
        }
        controller.update(t);
        const target = controller.targetBitsPerSecond(t);
        expect(target).toBeLessThanOrEqual(Math.min(40 * MBIT, limit));
        expect(target).toBeGreaterThanOrEqual(Math.min(MBIT, limit));
      }
    }),
    { seed: 1, numRuns: 300 },
  );
});
