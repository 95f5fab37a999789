/** For any sequence of requests, offers, answers, takeovers, stops, comings and goings, the lease moves only as agreed. */
import { HANDOVER_MS, type HandoverEnd } from '@farpoint/protocol';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { Handovers, type OpenHandover, REFUSED_MS } from './handovers.ts';

const sessions = ['a', 'b', 'c', 'w'] as const;
const session = fc.constantFrom(...sessions);
const step = fc.oneof(
  { weight: 4, arbitrary: fc.record({ kind: fc.constant('ask' as const), by: session }) },
  { weight: 4, arbitrary: fc.record({ kind: fc.constant('offer' as const), by: session, to: session }) },
  {
    weight: 6,
    arbitrary: fc.record({
      kind: fc.constant('answer' as const),
      by: session,
      /** Of the newest, or one before it. */
      back: fc.constantFrom(0, 0, 0, 1, 2),
      accept: fc.boolean(),
      addressee: fc.boolean(),
    }),
  },
  { weight: 1, arbitrary: fc.record({ kind: fc.constant('withdraw' as const), by: session }) },
  {
    weight: 1,
    arbitrary: fc.record({ kind: fc.constant('take' as const), by: fc.option(session, { nil: null }) }),
  },
  { weight: 1, arbitrary: fc.record({ kind: fc.constant('latch' as const), on: fc.boolean() }) },
  {
    weight: 1,
    arbitrary: fc.record({ kind: fc.constant('here' as const), by: session, here: fc.boolean() }),
  },
  { weight: 1, arbitrary: fc.record({ kind: fc.constant('look' as const) }) },
);
const timedStep = fc.record({ waitMs: fc.constantFrom(0, 1, 100, 5000, 14_999, 15_000, 20_000), step });

interface Seen {
  handover: OpenHandover;
  madeMs: number;
  lease: number;
  latch: number;
  end: HandoverEnd | null;
}

test('the lease moves only by an answer in time, from its holder, under the same lease, with no STOP since', () => {
  let accepted = 0;
  const ends = new Set<HandoverEnd>();
  fc.assert(
    fc.property(fc.array(timedStep, { minLength: 1, maxLength: 60, size: 'max' }), (steps) => {
      let nowMs = 0;
      let driver: string | null = 'a';
      let lease = 1;
      let latch = 0;
      let latched = false;
      const here = new Set<string>(sessions);
      const seen = new Map<number, Seen>();
      const refusedMs = new Map<string, number>();
      /** Set while somebody says yes. */
      let agreed: string | null = null;
      const handovers = new Handovers({
        facts: () => ({ driver, lease: driver === null ? null : `${lease}`, latched, latch }),
        mayDrive: (by) => (here.has(by) ? by !== 'w' : null),
        handOver: (from, to) => {
          expect(agreed).not.toBeNull();
          expect(from).toBe(driver);
          expect([to !== from, here.has(to), to !== 'w', latched]).toEqual([true, true, true, false]);
          [driver, lease] = [to, lease + 1];
          accepted++;
          return true;
        },
        changed: (handover, end) => {
          const known = seen.get(handover.id);
          if (end === null) {
            // Each id once; one for each maker; nothing while STOP is on.
            expect(known).toBeUndefined();
            expect(
              [...seen.values()].some((each) => each.end === null && each.handover.from === handover.from),
            ).toBe(false);
            expect(latched).toBe(false);
            expect(nowMs - (refusedMs.get(handover.from) ?? Number.NEGATIVE_INFINITY)).toBeGreaterThanOrEqual(
              REFUSED_MS,
            );
            seen.set(handover.id, { handover, madeMs: nowMs, lease, latch, end });
            return;
          }
          ends.add(end);
          // Each ends once.
          expect(known?.end).toBeNull();
          if (known === undefined) return;
          known.end = end;
          if (end === 'refused') refusedMs.set(handover.from, nowMs);
          if (end !== 'accepted') return;
          expect(agreed).toBe(handover.to);
          expect(nowMs - known.madeMs).toBeLessThan(HANDOVER_MS);
          expect([known.lease + 1, known.latch]).toEqual([lease, latch]);
          expect(driver).toBe(handover.kind === 'offer' ? handover.to : handover.from);
        },
      });
      for (const { waitMs, step } of steps) {
        nowMs += waitMs;
        const before = driver;
        if (step.kind === 'ask') handovers.ask(step.by, nowMs);
        else if (step.kind === 'offer') handovers.offer(step.by, step.to, nowMs);
        else if (step.kind === 'answer') {
          const { open } = handovers;
          const meant = open.at(-1 - step.back);
          const by = step.addressee ? (meant?.to ?? step.by) : step.by;
          agreed = step.accept ? by : null;
          handovers.answer(by, meant?.id ?? 99, step.accept, nowMs);
          agreed = null;
        } else if (step.kind === 'withdraw') {
          const mine = handovers.open.find(({ from }) => from === step.by);
          handovers.withdraw(step.by, mine?.id ?? 99, nowMs);
        } else if (step.kind === 'take') {
          if (step.by !== driver) [driver, lease] = [step.by, lease + 1];
        } else if (step.kind === 'latch') {
          if (step.on) latch++;
          latched = step.on;
        } else if (step.kind === 'here') {
          if (step.here) here.add(step.by);
          else {
            here.delete(step.by);
            if (driver === step.by) [driver, lease] = [null, lease + 1];
            handovers.gone(step.by, nowMs);
          }
        }
        if (step.kind !== 'answer' && step.kind !== 'take' && step.kind !== 'here')
          expect(driver).toBe(before);
        handovers.endDue(nowMs);
        // What is open is answerable: both are here, nothing has changed since, and its time is not over.
        expect(handovers.open.length).toBeLessThanOrEqual(sessions.length);
        for (const { id, from, to, endsMs } of handovers.open) {
          const made = seen.get(id);
          expect([made?.lease, made?.latch, made?.end]).toEqual([lease, latch, null]);
          expect([here.has(from), here.has(to), nowMs < endsMs, latched]).toEqual([true, true, true, false]);
        }
      }
    }),
    { seed: 21, numRuns: 1500 },
  );
  // Without this check, the property would hold for a robot that hands nothing over.
  expect(accepted).toBeGreaterThan(100);
  expect([...ends].sort()).toEqual(
    ['accepted', 'driver-changed', 'estop', 'expired', 'left', 'refused', 'withdrawn'].sort(),
  );
});
