import { expect, test } from 'vitest';
import { alarmEventWords, eventsWords } from './event-words.ts';

test('how many events are listed, kept and gone', () => {
  expect(eventsWords({ shown: 0, kept: 0, dropped: 0 })).toBe('Nothing has happened since it was cleared.');
  expect(eventsWords({ shown: 1, kept: 1, dropped: 0 })).toMatch(/^1 event, the newest first\. They stay/);
  expect(eventsWords({ shown: 250, kept: 1000, dropped: 7 })).toMatch(
    /^250 of 1000 events, the newest first; 7 older ones were dropped\./,
  );
});

test('an alarm that is over is no alarm', () => {
  const alarm = {
    type: 'alarm',
    number: 0,
    text: 'Hot',
    value: 70,
    limit: 80,
    unit: '°C',
    sinceMs: 0,
  } as const;
  expect(alarmEventWords({ ...alarm, level: 'ok' })).toEqual({
    text: 'Over: Hot (70 °C, limit 80 °C)',
    tone: 'good',
  });
  expect(alarmEventWords({ ...alarm, level: 'warn' })).toMatchObject({ tone: 'warning' });
});
