import { describe, expect, it } from 'vitest';
import { BatteryGauge } from './battery-gauge.ts';
import { readingOf } from './reading.ts';
import { numbersOf } from './topic-quantities.ts';
import { topicTableSchema } from './topic-table.ts';

const state = (percentage: number, voltage = 24) => ({ percentage, voltage });

describe('a battery gauge', () => {
  it.each([
    [0, 0],
    [0.85, 0.85],
    [1, 1],
    [1.000001, 1],
    [Number.NaN, null],
    [-0.01, null],
    [-1, null],
    [Number.POSITIVE_INFINITY, null],
    [85, 0.85],
    [100, 1],
    [8500, null],
  ])('told %d: a share of %s', (percentage, share) => {
    expect(new BatteryGauge().read(state(percentage)).share).toEqual(share);
  });

  it('that has told percent once tells percent from then on, and says so once', () => {
    const gauge = new BatteryGauge();
    expect(gauge.warning).toBeNull();
    gauge.read(state(85));
    expect(gauge.warning).toContain('read as percent');
    expect(gauge.warning).toBeNull();
    expect(gauge.read(state(0.9)).share).toBeCloseTo(0.009);
  });

  it('tells operators only what it knows', () => {
    const gauge = new BatteryGauge();
    expect(gauge.battery(state(0.5, 24))).toEqual({ percentage: 0.5, voltage: 24 });
    expect(gauge.battery(state(Number.NaN, 24))).toEqual({ voltage: 24 });
    expect(gauge.battery(state(0.5, Number.NaN))).toEqual({ percentage: 0.5 });
    expect(gauge.battery(state(-0.01, -1))).toBeNull();
    // JSON has no NaN.
    expect(gauge.battery({ percentage: null, voltage: 24 })).toEqual({ voltage: 24 });
  });
});

describe('a topic of a battery', () => {
  const [entry] = topicTableSchema.parse([{ topic: '/battery', as: 'battery' }]);

  it('has text and numbers of one scale', () => {
    const gauge = new BatteryGauge();
    for (const [percentage, text, level] of [
      [85, '85 %', 'ok'],
      [15, '15 %', 'warn'],
      [0.9, '1 %', 'error'],
    ] as const) {
      const reading = readingOf(entry!, state(percentage), gauge);
      expect(reading).toMatchObject({
        level,
        values: [
          ['', text],
          ['', '24.0 V'],
        ],
      });
      expect(numbersOf(entry!, state(percentage), gauge)[0]).toBeCloseTo(percentage);
    }
  });

  it('that does not know its charge is no empty one', () => {
    for (const percentage of [Number.NaN, -0.01]) {
      const gauge = new BatteryGauge();
      expect(readingOf(entry!, state(percentage), gauge)).toMatchObject({
        level: 'ok',
        values: [['', '24.0 V']],
      });
      expect(numbersOf(entry!, state(percentage), gauge)).toEqual([null, 24, null]);
    }
  });
});
