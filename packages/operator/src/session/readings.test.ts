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
    expect(readings.list(2010)).toEqual([{ reading: battery('79 %', 100), ageMs: 110, intervalMs: null }]);
  });

  it('with times, orders them exactly, and finds what was known at an instant', () => {
    const readings = new Readings();
    const at = (value: string, timeMs: number) => ({ ...battery(value), timeMs });
    readings.take(at('80 %', 1000), 10);
    readings.take(at('79 %', 1100), 110);
    expect(readings.take(at('80 %', 1000), 111)).toBe(false);
    expect(readings.take({ ...at('79 %', 1100), ageMs: 50 }, 160)).toBe(true);
    const shown = (instantMs?: number) => readings.list(160, instantMs)[0]?.reading.values[0]?.[1];
    expect(shown()).toBe('79 %');
    expect(shown(1100)).toBe('79 %');
    expect(shown(1099)).toBe('80 %');
    expect(shown(5)).toBe('80 %');
    for (let i = 0; i < 100; i++) readings.take(at(`${i} %`, 2000 + i), 1000 + i);
    expect(readings.list(0)[0]?.intervalMs).toBe(1);
    expect(shown(2050)).toBe('84 %');
    expect(shown(2090)).toBe('90 %');
  });

  it('keeps a bounded number of topics', () => {
    const readings = new Readings();
    for (let i = 0; i < 1000; i++) readings.take({ ...battery('1'), topic: `/${i}` }, i);
    expect(readings.list(1000)).toHaveLength(64);
  });
});
