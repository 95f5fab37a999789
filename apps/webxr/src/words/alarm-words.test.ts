import type { Alarm } from '@farpoint/operator';
import { expect, test } from 'vitest';
import { alarmLine, alarmWords, raisedFirst } from './alarm-words.ts';

const alarm = (level: Alarm['level'], sinceMs: number, value = 19.4567): Alarm => ({
  ...{ type: 'alarm', number: 0, level, text: 'The battery is low', value, limit: 20, unit: '%', sinceMs },
});

test('an alarm says what is wrong, the value and the limit', () => {
  expect(alarmWords(alarm('warn', 0), 20)).toEqual({
    text: 'The battery is low (19.5 %, limit 20 %)',
    tone: 'warning',
  });
  expect(alarmWords({ ...alarm('error', 0, -1234.5), unit: '' }, 999)).toEqual({
    text: 'The battery is low (-1234, limit 20)',
    tone: 'bad',
  });
});

test('an alarm of a recording says so', () => {
  expect(alarmWords({ ...alarm('warn', 0), recorded: true }, 0).text).toBe(
    'Recorded: The battery is low (19.5 %, limit 20 %)',
  );
});

test('an alarm of a robot that is not heard is of the past', () => {
  expect(alarmWords(alarm('error', 0), 3600)).toEqual({
    text: 'The battery is low (19.5 %, limit 20 %), 4 s ago',
    tone: 'bad',
  });
});

test('one line has the worst alarm, and says how many others there are', () => {
  expect(alarmLine([])).toBe(null);
  const low = alarmWords(alarm('error', 0), 0);
  expect(alarmLine([low])?.text).toBe('⚠ The battery is low (19.5 %, limit 20 %)');
  expect(alarmLine([low, low, low])).toEqual({
    text: '⚠ The battery is low (19.5 %, limit 20 %) (and 2 more)',
    tone: 'bad',
  });
});

test('errors come first, then what was raised last', () => {
  const sorted = [alarm('warn', 1), alarm('error', 2), alarm('warn', 3)].sort(raisedFirst);
  expect(sorted.map(({ sinceMs }) => sinceMs)).toEqual([2, 3, 1]);
});
