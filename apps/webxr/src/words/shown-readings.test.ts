import { Readings } from '@farpoint/operator';
import type { Reading } from '@farpoint/protocol';
import { describe, expect, it } from 'vitest';
import { shownReading } from './shown-readings.ts';

const battery = (value: string, ageMs = 0, level: Reading['level'] = 'ok'): Reading => ({
  ...{ type: 'reading', topic: '/battery', label: 'Battery', level, ageMs },
  values: [
    ['', value],
    ['cells', '7'],
  ],
});
const shown = (readings: Readings, nowMs: number) => readings.list(nowMs).map(shownReading);

describe('shownReading', () => {
  it('shows the newest reading of each topic, with names before values', () => {
    const readings = new Readings();
    readings.take(battery('80 %'), 1000);
    readings.take(battery('79 %', 0, 'warn'), 2000);
    // The channel is unordered: another reading overtook this one.
    readings.take(battery('81 %', 1500), 2010);
    expect(shown(readings, 2010)).toEqual([
      { topic: '/battery', label: 'Battery', text: '79 % · cells: 7', tone: 'warning' },
    ]);
  });

  it('shows the age of a reading that is not updated', () => {
    const readings = new Readings();
    readings.take(battery('80 %'), 1000);
    readings.take(battery('80 %', 2000), 3000);
    expect(shown(readings, 10_900)[0]).toMatchObject({ text: '80 % · cells: 7', tone: 'neutral' });
    expect(shown(readings, 31_000)[0]).toMatchObject({
      text: '80 % · cells: 7 (30 s ago)',
      tone: 'warning',
    });
  });
});
