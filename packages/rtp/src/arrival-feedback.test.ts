import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { ArrivalFeedback } from './arrival-feedback.ts';
import { parseTransportFeedback } from './transport-feedback.ts';
import { TransportFeedbackAdapter } from './transport-feedback-adapter.ts';

function takeAll(feedback: ArrivalFeedback) {
  const messages = [];
  for (;;) {
    const bytes = feedback.take(1, 2);
    if (bytes === null) return messages;
    expect(bytes.length).toBeLessThan(1200);
    messages.push(parseTransportFeedback(bytes));
  }
}

describe('ArrivalFeedback', () => {
  it('reports each packet that arrived and each gap once, across messages and across the wrap of the number', () => {
    const gaps = fc.array(
      fc.oneof({ weight: 9, arbitrary: fc.constant(1) }, fc.integer({ min: 1, max: 700 })),
      {
        minLength: 1,
        maxLength: 1500,
      },
    );
    fc.assert(
      fc.property(gaps, fc.nat(200), (steps, askEvery) => {
        const feedback = new ArrivalFeedback();
        const sender = new TransportFeedbackAdapter();
        const told = new Map<number, boolean>();
        const sent = new Set<number>();
        let sequence = 65_000;
        let now = 5000;
        const ask = () => {
          for (const message of takeAll(feedback))
            for (const { transportSequence, arrivalUs } of sender.onFeedback(message, now)) {
              expect(told.has(transportSequence)).toBe(false);
              told.set(transportSequence, arrivalUs !== null);
            }
        };
        const came = new Set<number>();
        for (const [i, step] of steps.entries()) {
          now += 0.2;
          for (let k = 0; k < step; k++) sender.onPacketSent((sequence + k) & 0xffff, 1280, now);
          for (let k = 0; k < step; k++) sent.add((sequence + k) & 0xffff);
          sequence = (sequence + step) & 0xffff;
          came.add((sequence - 1) & 0xffff);
          feedback.add((sequence - 1) & 0xffff, now);
          if (i % (askEvery + 1) === 0) ask();
        }
        ask();
        for (const [one, received] of told) expect(came.has(one)).toBe(received);
        const lastTold = told.get((sequence - 1) & 0xffff);
        expect(lastTold).toBe(true);
      }),
      { seed: 13, numRuns: 40 },
    );
  });

  it('reports nothing if nothing arrived, and leaves out packets that arrive after they were reported lost', () => {
    const feedback = new ArrivalFeedback();
    expect(feedback.take(1, 2)).toBeNull();
    feedback.add(10, 1);
    feedback.add(12, 2);
    expect(takeAll(feedback).map(({ packets }) => packets.map(({ received }) => received))).toEqual([
      [true, false, true],
    ]);
    feedback.add(11, 3);
    expect(feedback.take(1, 2)).toBeNull();
  });
});
