import { expect, test } from 'vitest';
import { SentPacketHistory } from './sent-packet-history.ts';
import type { TransportFeedback } from './transport-feedback.ts';
import { TransportFeedbackAdapter } from './transport-feedback-adapter.ts';

function feedback(
  baseSequence: number,
  referenceTimeUs: number,
  arrivals: (number | null)[],
): TransportFeedback {
  return {
    senderSsrc: 1,
    mediaSsrc: 2,
    baseSequence,
    referenceTimeUs,
    feedbackCount: 0,
    packets: arrivals.map((arrivalUs, i) => ({
      sequence: (baseSequence + i) & 0xffff,
      received: arrivalUs !== null,
      arrivalUs,
    })),
  };
}

test('joins feedback with what was sent, across the wrap of the numbers', () => {
  const adapter = new TransportFeedbackAdapter();
  adapter.onPacketSent(65_535, 1244, 10);
  adapter.onPacketSent(0, 1244, 11);
  adapter.onPacketSent(1, 300, 12);
  expect(adapter.onFeedback(feedback(65_535, 0, [250, null, 750]), 60)).toEqual([
    { transportSequence: 65_535, bytes: 1244, sentMs: 10, arrivalUs: 250 },
    { transportSequence: 0, bytes: 1244, sentMs: 11, arrivalUs: null },
    { transportSequence: 1, bytes: 300, sentMs: 12, arrivalUs: 750 },
  ]);
});

test('leaves out and counts unknown packets: never sent, or reported before', () => {
  const adapter = new TransportFeedbackAdapter(new SentPacketHistory(16));
  adapter.onPacketSent(5, 100, 0);
  expect(adapter.onFeedback(feedback(4, 0, [0, 250, 500]), 10)).toHaveLength(1);
  expect(adapter.onFeedback(feedback(5, 0, [250]), 20)).toEqual([]);
  expect(adapter.unknownPackets).toBe(3);
});

test('arrival times continue across the wrap of the reference time, and go back for a late message', () => {
  const adapter = new TransportFeedbackAdapter();
  const last = (2 ** 23 - 1) * 64_000;
  const first = -(2 ** 23) * 64_000;
  const arrivalOf = (sequence: number, reference: number) => {
    adapter.onPacketSent(sequence, 100, 0);
    return adapter.onFeedback(feedback(sequence, reference, [reference + 250]), 0)[0]?.arrivalUs;
  };
  expect(arrivalOf(1, last)).toBe(last + 250);
  expect(arrivalOf(2, first)).toBe(last + 64_000 + 250);
  expect(arrivalOf(3, last)).toBe(last + 250);
  expect(arrivalOf(4, first + 64_000)).toBe(last + 128_000 + 250);
});
