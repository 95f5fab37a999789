import type { Reading } from '@farpoint/protocol';
import { describe, expect, it } from 'vitest';
import { Readings } from './readings.ts';

const battery = (value: string, ageMs = 0): Reading => ({
  ...{ type: 'reading', topic: '/battery', label: 'Battery', level: 'ok', ageMs },
  values: [['', value]],
});

describe('Readings', () => {
  it('keeps the newest of each topic and tells its age', () => {
    const readings = new Readings();
    expect(readings.take(battery('80 %'), 1000)).toBe(true);
    expect(readings.take(battery('79 %', 100), 2000)).toBe(true);
    // The channel is unordered: this reading was overtaken.
    expect(readings.take(battery('81 %', 1500), 2010)).toBe(false);
    expect(readings.list(2010)).toEqual([{ reading: battery('79 %', 100), ageMs: 110 }]);
  });

  it('keeps a bounded number of topics', () => {
    const readings = new Readings();
    for (let i = 0; i < 1000; i++) readings.take({ ...battery('1'), topic: `/${i}` }, i);
    expect(readings.list(1000)).toHaveLength(64);
  });
});
