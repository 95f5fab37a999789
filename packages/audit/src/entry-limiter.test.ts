import fc from 'fast-check';
import { expect, it } from 'vitest';
import type { AuditEvent } from './audit-event.ts';
import { EntryLimiter } from './entry-limiter.ts';

const by = (id: string, kind: AuditEvent['kind'] = 'lease-given'): AuditEvent => ({
  kind,
  session: `session-${id}`,
  subject: { id, name: id, proven: true },
});
const stranger = (session: string, kind: AuditEvent['kind'] = 'lease-given'): AuditEvent => ({
  kind,
  session,
  subject: { name: 'whoever', proven: false },
});
const admitted = (limiter: EntryLimiter, events: readonly AuditEvent[], nowMs = 0) =>
  events.filter((event) => limiter.admits(event, nowMs)).length;
const times = (count: number, make: (i: number) => AuditEvent) =>
  Array.from({ length: count }, (_, i) => make(i));

it('what one subject does as often as it likes hides nothing that another does', () => {
  const limiter = new EntryLimiter();
  expect(
    admitted(
      limiter,
      times(60, () => by('eve')),
    ),
  ).toBe(50);
  expect(
    admitted(
      limiter,
      times(60, () => stranger('s1')),
    ),
  ).toBe(50);
  expect(limiter.admits(by('ada'), 0)).toBe(true);
  expect(limiter.admits(stranger('s2'), 0)).toBe(true);
  expect(limiter.admits({ kind: 'estop-latched', details: { by: 'robot' } }, 0)).toBe(true);
  // Nor what it does itself of another kind.
  expect(limiter.admits(by('eve', 'estop-latched'), 0)).toBe(true);
  expect(limiter.takeOmitted()).toEqual({ 'lease-given by eve': 10, 'lease-given by s1': 10 });
});

it('strangers cannot fill the disk with ever new sessions, and hide nobody whom a grant names', () => {
  const limiter = new EntryLimiter();
  expect(
    admitted(
      limiter,
      times(10_000, (i) => stranger(`s${i}`)),
    ),
  ).toBe(250);
  expect(
    admitted(
      limiter,
      times(10_000, (i) => stranger(`t${i}`)),
      10_000,
    ),
  ).toBe(10);
  expect(limiter.admits(by('ada'), 10_000)).toBe(true);
  const connected = (i: number): AuditEvent => ({
    kind: 'connected',
    details: { address: `192.0.2.${i % 9}` },
  });
  expect(admitted(limiter, times(10_000, connected), 10_000)).toBe(250);
  const omitted = limiter.takeOmitted() ?? {};
  expect(Object.keys(omitted).length).toBeLessThanOrEqual(64 + 2);
});

it('a subject’s first entry of a kind is written, whatever others of other subjects came before', () => {
  fc.assert(
    fc.property(fc.array(fc.tuple(fc.constantFrom('a', 'b', 'c', 'd'), fc.boolean())), (events) => {
      const limiter = new EntryLimiter();
      for (const [who, proven] of events.flatMap((each) => times(60, () => by('x')).map(() => each)))
        limiter.admits(proven ? by(who) : stranger(who), 0);
      expect(limiter.admits(by('late'), 0)).toBe(true);
    }),
    { numRuns: 30 },
  );
});
