import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { EventLog, MOST_EVENTS } from './event-log.ts';
import type { EventDetail } from './page-event.ts';
import { keepEvents, keptText, parseKept } from './stored-events.ts';

const NOTHING = { events: [], dropped: 0 };

const text = fc.string({ maxLength: 200 });
const detail: fc.Arbitrary<EventDetail> = fc.oneof(
  fc.record({ kind: fc.constant('request-refused' as const), detail: text }),
  fc.record({
    kind: fc.constant('held' as const),
    reasons: fc.subarray(['obstacle', 'fence', 'view-late'] as const),
  }),
  fc.record({
    kind: fc.constant('loss-high' as const),
    percent: fc.double({ noNaN: true, min: 0, max: 100 }),
  }),
);
const kept = fc.record({
  events: fc.array(
    fc.record({
      atMs: fc.nat(),
      lastMs: fc.nat(),
      times: fc.integer({ min: 1 }),
      sessionMs: fc.option(fc.nat()),
      robot: fc.option(text),
      detail,
    }),
    { maxLength: 20 },
  ),
  dropped: fc.nat(),
});

function tab(stored: string | null) {
  const values = new Map(stored === null ? [] : [['farpoint.events', stored]]);
  return {
    getItem: (key: string) => values.get(key) ?? null,
    setItem: (key: string, value: string) => void values.set(key, value),
    get text() {
      return values.get('farpoint.events');
    },
  };
}

describe('what the tab keeps of the event log', () => {
  test('is read as it was written', () => {
    fc.assert(
      fc.property(
        kept,
        (all) => void expect(parseKept(keptText(all))).toEqual(JSON.parse(JSON.stringify(all))),
      ),
    );
  });

  test('is nothing if it is anything else', () => {
    fc.assert(
      fc.property(fc.oneof(fc.string(), fc.json()), (any) => void expect(parseKept(any)).toEqual(NOTHING)),
    );
    const event = { atMs: 1, lastMs: 1, times: 1, sessionMs: null, robot: null, detail: { kind: 'free' } };
    const stored = (change: object) => JSON.stringify({ events: [{ ...event, ...change }], dropped: 0 });
    expect(parseKept(stored({})).events).toHaveLength(1);
    for (const change of [
      { atMs: -1 },
      { atMs: 9e15 },
      { times: 0 },
      { robot: 'x'.repeat(201) },
      { detail: { kind: 'unknown' } },
      { detail: { kind: 'held', reasons: ['ghost'] } },
      { detail: { kind: 'request-refused', detail: 7 } },
    ])
      expect(parseKept(stored(change))).toEqual(NOTHING);
    const many = { events: Array(MOST_EVENTS + 1).fill(event), dropped: 0 };
    expect(parseKept(JSON.stringify(many))).toEqual(NOTHING);
    expect(parseKept(null)).toEqual(NOTHING);
  });

  test('comes back before what has happened since, and is kept when the page is left or hidden', () => {
    const before = new EventLog(() => 1000);
    before.add({ kind: 'path-lost' }, { robot: 'Rover', sessionMs: 5 });
    const storage = tab(keptText(before.kept));
    const log = new EventLog(() => 2000);
    log.add({ kind: 'page-opened' }, { robot: null, sessionMs: null });
    const page = new EventTarget();
    keepEvents(log, page, () => storage);
    const kinds = (all: ReturnType<typeof parseKept>) => all.events.map((event) => event.detail.kind);
    expect(kinds(log.kept)).toEqual(['path-lost', 'page-opened']);
    for (const type of ['pagehide', 'visibilitychange']) {
      storage.setItem('farpoint.events', '');
      page.dispatchEvent(new Event(type));
      expect(kinds(parseKept(storage.text ?? null))).toEqual(['path-lost', 'page-opened']);
    }
  });

  test('is nothing where the page may store nothing', () => {
    const log = new EventLog(() => 1000);
    const page = new EventTarget();
    keepEvents(log, page, () => {
      throw new Error('no storage');
    });
    page.dispatchEvent(new Event('pagehide'));
    expect(log.kept).toEqual(NOTHING);
  });
});
