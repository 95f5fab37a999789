import { describe, expect, test } from 'vitest';
import { AGAIN_MS, EventLog, MOST_EVENTS } from './event-log.ts';
import { severityOf } from './event-table.ts';
import { type EventDetail, MOST_TEXT } from './page-event.ts';

const nobody = { robot: null, sessionMs: null };
const rover = { robot: 'Rover', sessionMs: 1500 };
const refused: EventDetail = { kind: 'command-refused', reason: 'stale' };
const yours: EventDetail = { kind: 'lease', holder: 'you', driver: '' };

function setUp() {
  const clock = { ms: 1_000_000 };
  const log = new EventLog(() => clock.ms);
  const kinds = () => log.kept.events.map(({ detail, times }) => `${detail.kind} ×${times}`);
  return { clock, log, kinds };
}

describe('the event log', () => {
  test('keeps what happened, when, how far into the session, and with which robot', () => {
    const { log } = setUp();
    log.add(yours, rover);
    log.add({ kind: 'signaling', state: 'waiting' }, nobody);
    expect(log.kept).toEqual({
      dropped: 0,
      events: [
        { atMs: 1_000_000, lastMs: 1_000_000, times: 1, sessionMs: 1500, robot: 'Rover', detail: yours },
        {
          atMs: 1_000_000,
          lastMs: 1_000_000,
          times: 1,
          sessionMs: null,
          robot: null,
          detail: { kind: 'signaling', state: 'waiting' },
        },
      ],
    });
  });

  test('drops the oldest, and knows how many', () => {
    const { log, clock } = setUp();
    for (let i = 0; i < MOST_EVENTS + 7; i++) {
      clock.ms += 1000;
      log.add({ kind: 'robot-chosen', robotId: String(i) }, nobody);
    }
    expect(log.kept.events).toHaveLength(MOST_EVENTS);
    expect(log.kept.events[0]?.detail).toEqual({ kind: 'robot-chosen', robotId: '7' });
    expect(log.kept.dropped).toBe(7);
    log.clear();
    expect(log.kept).toEqual({ events: [], dropped: 0 });
  });

  test('counts what repeats, with its newest numbers; later, or of another robot, it is an entry of its own', () => {
    const { log, clock, kinds } = setUp();
    log.add(refused, rover, 3);
    clock.ms += AGAIN_MS;
    log.add(refused, rover, 9);
    expect(log.kept.events).toMatchObject([{ atMs: 1_000_000, lastMs: clock.ms, times: 12 }]);
    log.add(refused, nobody);
    log.add({ kind: 'command-refused', reason: 'repeated' }, rover);
    clock.ms += AGAIN_MS + 1;
    log.add(refused, rover);
    const once = 'command-refused ×1';
    expect(kinds()).toEqual(['command-refused ×12', once, once, once]);
    log.add({ kind: 'rate-fell', fromKbps: 8000, toKbps: 3000 }, rover);
    log.add({ kind: 'rate-fell', fromKbps: 9000, toKbps: 2000 }, rover);
    expect(log.kept.events.at(-1)).toMatchObject({ times: 2, detail: { fromKbps: 9000, toKbps: 2000 } });
  });

  test('keeps the order of what has its own place: nothing after it is counted before it', () => {
    const { log, kinds } = setUp();
    log.add(refused, rover);
    log.add(yours, rover);
    log.add(yours, rover);
    log.add(refused, rover);
    log.add(refused, rover);
    expect(kinds()).toEqual(['command-refused ×1', 'lease ×1', 'lease ×1', 'command-refused ×2']);
  });

  test('lets nobody push out what happened: what comes too fast is counted, and what is too long is cut', () => {
    const { log, clock } = setUp();
    const told: number[] = [];
    log.onEvent = (_, times) => void told.push(times);
    for (let i = 0; i < 1000; i++) log.add({ kind: 'robot-fault', detail: `${'x'.repeat(i)}` }, rover);
    expect(log.kept.events).toHaveLength(100);
    expect(told).toHaveLength(1000);
    clock.ms += 1000;
    log.add({ kind: 'robot-fault', detail: 'y'.repeat(5 * MOST_TEXT) }, { ...rover, robot: 'R'.repeat(999) });
    const [counted, last] = log.kept.events.slice(-2);
    expect(counted?.detail).toEqual({ kind: 'suppressed', count: 900 });
    expect(last?.detail).toEqual({ kind: 'robot-fault', detail: 'y'.repeat(MOST_TEXT) });
    expect(last?.robot).toHaveLength(MOST_TEXT);
    // What happened before stays for three minutes.
    log.add(yours, rover);
    for (let i = 0; i < 3 * 60 * 20; i++) {
      clock.ms += 50;
      log.add({ kind: 'robot-fault', detail: String(i) }, rover);
    }
    expect(log.kept.events.map(({ detail }) => detail)).toContainEqual(yours);
  });

  test('tells that it has changed', () => {
    const { log } = setUp();
    const seen = [log.revision.value];
    log.add(refused, rover);
    seen.push(log.revision.value);
    log.add(refused, rover);
    seen.push(log.revision.value);
    log.clear();
    seen.push(log.revision.value);
    expect(new Set(seen).size).toBe(4);
  });
});

test('what is as severe as what it says', () => {
  const alarm = { text: 'Hot', value: 90, limit: 80, unit: '°C', recorded: false };
  expect(severityOf({ kind: 'alarm', level: 'warn', ...alarm })).toBe('warning');
  expect(severityOf({ kind: 'alarm', level: 'error', ...alarm })).toBe('error');
  expect(severityOf({ kind: 'stop-delivery', status: 'confirmed' })).toBe('info');
  expect(severityOf({ kind: 'stop-delivery', status: 'unconfirmed' })).toBe('warning');
  expect(severityOf({ kind: 'stop-delivery', status: 'undelivered' })).toBe('error');
  expect(severityOf({ kind: 'guard-state', state: 'blind' })).toBe('warning');
  expect(severityOf({ kind: 'guard-state', state: 'on' })).toBe('info');
  expect(severityOf({ kind: 'signaling', state: 'refused' })).toBe('warning');
  expect(severityOf({ kind: 'signaling', state: 'ready' })).toBe('info');
});
