import { Readings } from '@farpoint/operator';
import type { Reading } from '@farpoint/protocol';
import { expect, test } from 'vitest';
import { readingsWithNavigation } from './navigation-words.ts';

const reading = (topic: string, text: string, level: Reading['level'] = 'ok'): Reading => ({
  ...{
    type: 'reading',
    topic,
    label: topic === '/map' ? 'Map' : 'Path',
    level,
    ageMs: 0,
    values: [['', text]],
  },
});

/** What the status panel says of the navigator, with these ages of what is known. */
function told({ pathMs = 0, mapMs = 0, silentMs = 0, level = 'ok' as Reading['level'] }) {
  const readings = new Readings();
  readings.take(reading('/plan', '6.3 m', level), 0);
  readings.take(reading('/map', '20.1 × 12.1 m', level), 0);
  const points = [
    [0, 0],
    [1, 0],
  ];
  const place = { width: 1, height: 1, cellM: 1, origin: { x: 0, y: 0, yaw: 0 } };
  const session = {
    readings,
    plannedPath: { topic: '/plan', points, ageMs: () => pathMs },
    map: {
      topic: '/map',
      place,
      cells: new Uint8Array(1),
      changes: 1,
      ageMs: () => mapMs,
      silentMs: () => silentMs,
    },
  };
  return readingsWithNavigation(session as never, 0).map(({ text, tone }) => [text, tone]);
}

test('what is drawn has its length or size, and a map its age', () => {
  expect(told({ mapMs: 200_000 })).toEqual([
    ['6.3 m', 'neutral'],
    ['20.1 × 12.1 m, 3 min old', 'neutral'],
  ]);
});

test('what is too old to be drawn says so', () => {
  expect(told({ pathMs: 7600, mapMs: 8_000_000, silentMs: 20_000 })).toEqual([
    ['6.3 m, 8 s old: not drawn', 'warning'],
    ['20.1 × 12.1 m, not heard for 20 s: not drawn', 'warning'],
  ]);
});

test('what the robot refuses keeps its own words', () => {
  expect(told({ level: 'warn' })).toEqual([
    ['6.3 m', 'warning'],
    ['20.1 × 12.1 m', 'warning'],
  ]);
});
