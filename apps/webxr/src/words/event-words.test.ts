import { afterEach, describe, expect, test } from 'vitest';
import type { KeptEvents } from '../ground/events/event-log.ts';
import type { DetailOf, EventDetail, PageEvent } from '../ground/events/page-event.ts';
import { laterEnglish } from './en/later-catalogue.ts';
import { eventsCsv, eventsJsonLines, eventText, passes } from './event-words.ts';
import { speak } from './language.ts';

const alarm = { text: 'Motor hot', value: 91, limit: 80, unit: '°C', recorded: false };
const stop: Omit<DetailOf<'stop'>, 'kind'> = {
  by: 'operator',
  name: 'Bo',
  heldBy: [],
  start: null,
  already: false,
};
/** Details, what they say in English, and a part of what they say in German. */
const SAID: readonly (readonly [EventDetail, string, string])[] = [
  [
    { kind: 'session-lost', reason: 'silent', detail: '' },
    'Session ended: the robot did not respond.',
    'Sitzung beendet',
  ],
  [
    { kind: 'session-lost', reason: 'ended-by-supervisor', detail: 'Cy' },
    'Session ended: ended by a supervisor (Cy).',
    'Aufsicht beendet (Cy)',
  ],
  [{ kind: 'robot-heard', silentMs: 2340 }, 'The robot is heard again after 2.3 s.', 'nach 2.3 s'],
  [{ kind: 'lease', holder: 'other', driver: '' }, 'Another operator drives.', 'Eine andere Person fährt'],
  [{ kind: 'lease', holder: 'other', driver: 'Bo' }, 'Bo drives.', 'Bo fährt'],
  [
    { kind: 'handover', step: 'ask', from: 'Ann', to: 'Bo', ended: 'accepted' },
    'Ann asked Bo for the drive: accepted.',
    'angenommen',
  ],
  [{ kind: 'command-refused', reason: 'stale' }, 'Command refused: too old on arrival.', 'zu alt angekommen'],
  [{ kind: 'stop', ...stop }, 'Emergency stop by Bo.', 'Not-Halt durch Bo'],
  [{ kind: 'stop', ...stop, name: '' }, 'Emergency stop by another operator.', 'eine andere Person'],
  [
    { kind: 'stop', ...stop, by: 'you', already: true },
    'Emergency stop by you (when the session began).',
    'durch Sie',
  ],
  [
    { kind: 'stop', ...stop, by: 'robot', heldBy: ['gpio'] },
    'Emergency stop by a stop button on the robot.',
    'Taster',
  ],
  [
    { kind: 'stop', ...stop, by: 'robot', start: 'unclean-exit' },
    'Emergency stop since the robot’s start: the last run did not shut down in order.',
    'nicht ordnungsgemäß',
  ],
  [
    { kind: 'stop-released', by: 'operator', name: 'Bo' },
    'The emergency stop was released by Bo.',
    'durch Bo',
  ],
  [
    { kind: 'stop-released', by: 'robot', name: '' },
    'The emergency stop was released at the robot.',
    'am Roboter',
  ],
  [
    { kind: 'held', reasons: ['obstacle', 'fence'] },
    'The robot holds itself: an obstacle is in the way, edge of the geofence.',
    'Hindernis im Weg',
  ],
  [{ kind: 'alarm', level: 'error', ...alarm }, 'Alarm: Motor hot (91 °C, limit 80 °C)', 'Grenzwert 80 °C'],
  [
    { kind: 'alarm-cleared', ...alarm, unit: '', recorded: true },
    'Alarm cleared: Recorded: Motor hot (91, limit 80)',
    'Aufgezeichnet: Motor hot (91, Grenzwert 80)',
  ],
  [{ kind: 'setting', name: 'cues', on: false }, 'Sound and vibration: off.', 'Ton und Vibration: aus'],
];

const eventOf = (detail: EventDetail, change: Partial<PageEvent> = {}): PageEvent => ({
  atMs: Date.UTC(2026, 10, 30, 11, 12, 5, 123),
  lastMs: Date.UTC(2026, 10, 30, 11, 12, 9),
  times: 1,
  sessionMs: 61_234.5,
  robot: 'Rover',
  detail,
  ...change,
});
const keptOf = (...events: PageEvent[]): KeptEvents => ({ events, dropped: 0 });

afterEach(() => speak('en'));

describe('what happened, in words', () => {
  test.each(SAID)('%j', async (detail, inEnglish, partOfGerman) => {
    expect(eventText(detail)).toBe(inEnglish);
    await speak('de');
    expect(eventText(detail)).toContain(partOfGerman);
    expect(eventText(detail, laterEnglish)).toBe(inEnglish);
  });

  test('is filtered by its part of the log, its words and the robot’s name', async () => {
    const event = eventOf({ kind: 'command-refused', reason: 'stale' });
    const all = { group: null, text: '' };
    expect(passes(event, all)).toBe(true);
    expect(passes(event, { ...all, group: 'driving' })).toBe(true);
    expect(passes(event, { ...all, group: 'alarms' })).toBe(false);
    expect(passes(event, { ...all, text: ' TOO OLD ' })).toBe(true);
    expect(passes(event, { ...all, text: 'rover' })).toBe(true);
    expect(passes(event, { ...all, text: 'zu alt' })).toBe(false);
    await speak('de');
    expect(passes(event, { ...all, text: 'zu alt' })).toBe(true);
  });
});

describe('files of the log', () => {
  test('JSON Lines have the times, the kind and the typed parameters, and English whatever the page speaks', async () => {
    await speak('de');
    const event = eventOf({ kind: 'command-refused', reason: 'stale' }, { times: 12 });
    const lines = eventsJsonLines(keptOf(event, eventOf({ kind: 'free' }, { sessionMs: null, robot: null })));
    expect(
      lines
        .split('\n')
        .slice(0, -1)
        .map((line) => JSON.parse(line) as unknown),
    ).toEqual([
      {
        time: '2026-11-30T11:12:05.123Z',
        lastTime: '2026-11-30T11:12:09.000Z',
        times: 12,
        sessionS: 61.235,
        robot: 'Rover',
        severity: 'warning',
        kind: 'command-refused',
        details: { reason: 'stale' },
        text: 'Command refused: too old on arrival.',
      },
      expect.objectContaining({ sessionS: null, robot: null, kind: 'free', details: {} }),
    ]);
  });

  test('CSV has a row for each, quoted where needed', () => {
    const event = eventOf({ kind: 'request-refused', detail: 'say "no", twice' }, { times: 2 });
    expect(eventsCsv(keptOf(event))).toBe(
      'time,lastTime,times,sessionS,robot,severity,kind,details,text\r\n' +
        '2026-11-30T11:12:05.123Z,2026-11-30T11:12:09.000Z,2,61.235,Rover,warning,request-refused,' +
        '"{""detail"":""say \\""no\\"", twice""}",' +
        '"The signaling service refused a request: say ""no"", twice"\r\n',
    );
  });

  test.each(['=1+1', '+1', '-1', '@SUM(A1)', '\t=1', '\r=1'])('a robot named %j is no formula', (robot) => {
    const row = eventsCsv(keptOf(eventOf({ kind: 'free' }, { robot }))).slice('time'.length);
    expect(row).toMatch(/,"?'[=+\-@\t\r]/);
    expect(row).not.toMatch(/,"?[=+\-@\t\r][^\n]/);
  });

  test('say how many older events were dropped', () => {
    const kept = { events: [eventOf({ kind: 'free' })], dropped: 7 };
    const [first] = eventsJsonLines(kept).split('\n');
    expect(JSON.parse(first ?? '')).toMatchObject({ kind: 'dropped', details: { count: 7 }, times: 7 });
    expect(eventsCsv(kept).split('\r\n')[1]).toContain('7 older events were dropped.');
  });
});
