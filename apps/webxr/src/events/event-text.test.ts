import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { MOST_TEXT, type PageEvent, SEVERITIES } from './event-log.ts';
import { eventsCsv, eventsJsonLines, eventsText, parseEvents } from './event-text.ts';

const event: PageEvent = {
  ...{ atMs: Date.UTC(2026, 0, 2, 3, 4, 5, 678), lastMs: Date.UTC(2026, 0, 2, 3, 4, 9), times: 2 },
  ...{ robot: 'Rover', severity: 'warning', text: 'Refused: "too fast", twice' },
};
const anyEvent = fc.record({
  atMs: fc.integer({ min: 0, max: 8.64e15 }),
  lastMs: fc.integer({ min: 0, max: 8.64e15 }),
  times: fc.integer({ min: 1 }),
  robot: fc.option(fc.string({ maxLength: 60 })),
  severity: fc.constantFrom(...SEVERITIES),
  text: fc.string({ maxLength: MOST_TEXT, unit: 'grapheme' }).map((text) => text.slice(0, MOST_TEXT)),
});

test('a table: quoted where it must be, times in UTC, nothing that a spreadsheet computes', () => {
  expect(eventsCsv([event, { ...event, robot: null, text: '=1+1' }])).toBe(
    'time,last_time,times,robot,severity,text\r\n' +
      '2026-01-02T03:04:05.678Z,2026-01-02T03:04:09.000Z,2,Rover,warning,"Refused: ""too fast"", twice"\r\n' +
      "2026-01-02T03:04:05.678Z,2026-01-02T03:04:09.000Z,2,,warning,'=1+1\r\n",
  );
});

test('JSON lines: one object a line, with every text as it was', () => {
  fc.assert(
    fc.property(fc.array(anyEvent, { maxLength: 5 }), (events) => {
      const lines = eventsJsonLines(events).split('\n');
      expect(lines.pop()).toBe('');
      const read = lines.map((line) => JSON.parse(line) as PageEvent);
      expect(read.map(({ robot, text, times }) => ({ robot, text, times }))).toEqual(
        events.map(({ robot, text, times }) => ({ robot, text, times })),
      );
    }),
  );
});

describe('what the tab keeps', () => {
  test('is read as it was written', () => {
    fc.assert(
      fc.property(fc.array(anyEvent, { maxLength: 5 }), fc.nat(), (events, dropped) => {
        expect(parseEvents(eventsText({ events, dropped }))).toEqual({ events, dropped });
      }),
    );
  });

  test('whatever else is found there is nothing', () => {
    const nothing = { events: [], dropped: 0 };
    const broken = { ...event, severity: 'loud' };
    for (const text of [
      null,
      '',
      '{',
      '[]',
      '{"events":[1]}',
      JSON.stringify({ events: [broken], dropped: 0 }),
    ])
      expect(parseEvents(text)).toEqual(nothing);
    fc.assert(fc.property(fc.string(), (text) => void parseEvents(text)));
    fc.assert(fc.property(fc.json(), (text) => void parseEvents(text)));
  });
});
