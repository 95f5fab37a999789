import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { Curve } from './curve.ts';
import { Series } from './series.ts';

const value = fc.double({ min: -1e6, max: 1e6, noNaN: true });
const samples = fc.array(fc.tuple(fc.integer({ min: 1, max: 40 }), value), { minLength: 1, maxLength: 600 });

/** The samples with absolute times. */
function timed(steps: [number, number][]): [number, number][] {
  let time = 0;
  return steps.map(([step, each]) => {
    time += step;
    return [time, each];
  });
}

describe('the curve of a series', () => {
  test('has the extremes of every column, and nothing that was not measured', () => {
    fc.assert(
      fc.property(samples, fc.integer({ min: 1, max: 80 }), (steps, columns) => {
        const all = timed(steps);
        const series = new Series();
        for (const [time, each] of all) series.add(time, each);
        const [from, to] = [all[0]![0], all.at(-1)![0] + 1];
        const curve = new Curve(columns);
        series.curve(from, to, curve);
        const drawn = curve.xs.map((x, i) => [x * 1000 + to, curve.ys[i]] as const);
        expect(drawn.length).toBeLessThanOrEqual(2 * columns);
        const columnOf = (time: number) => Math.floor(((time - from) / (to - from)) * columns);
        for (let column = 0; column < columns; column++) {
          const of = (list: readonly (readonly [number, number | null | undefined])[]) =>
            list.filter(([time]) => columnOf(time + 1e-6) === column).map(([, each]) => each as number);
          const [measured, shown] = [of(all), of(drawn)];
          if (measured.length === 0) expect(shown).toEqual([]);
          else {
            expect(Math.min(...shown)).toBe(Math.min(...measured));
            expect(Math.max(...shown)).toBe(Math.max(...measured));
          }
        }
        for (let i = 1; i < drawn.length; i++) expect(drawn[i]![0]).toBeGreaterThanOrEqual(drawn[i - 1]![0]);
        const values = all.map(([, each]) => each);
        expect(series.range(from, to)).toEqual({ least: Math.min(...values), most: Math.max(...values) });
      }),
      { seed: 1, numRuns: 200 },
    );
  });

  test('is interrupted where nothing came', () => {
    const series = new Series();
    for (const time of [0, 100, 200, 5000, 5100]) series.add(time, 1);
    const curve = new Curve(1000);
    series.curve(0, 6000, curve);
    expect(curve.ys).toEqual([1, 1, 1, null, 1, 1]);
    expect(curve.xs[0]).toBe(-6);
  });

  test('of an hour at 50 Hz keeps a spike, in bounded memory and few points', () => {
    const series = new Series();
    const hourMs = 3_600_000;
    for (let time = 0; time < hourMs; time += 20)
      series.add(time, time === 600_000 ? 99 : Math.sin(time / 1e5));
    expect(series.length).toBe(32_768);
    const curve = new Curve(500);
    series.curve(0, hourMs, curve);
    expect(curve.xs.length).toBeLessThanOrEqual(1000);
    expect(Math.max(...curve.ys.map((each) => each ?? 0))).toBe(99);
    expect(series.range(0, hourMs)?.most).toBe(99);
    // The last minutes are drawn from the samples themselves.
    expect(series.range(hourMs - 60_000, hourMs)?.most).toBeLessThanOrEqual(1);
  });
});

describe('a value of a series', () => {
  test('is the nearest that is not newer than the instant', () => {
    const series = new Series();
    expect(series.at(0)).toBeNull();
    for (const time of [100, 150, 200]) series.add(time, time);
    expect(series.at(99)).toBeNull();
    expect(series.at(199)).toEqual({ value: 150, timeMs: 150 });
    expect(series.at(Number.POSITIVE_INFINITY)?.value).toBe(200);
  });

  test('becomes stale by its own rate', () => {
    const staleMs = (intervalMs: number, count: number) => {
      const series = new Series();
      for (let i = 0; i < count; i++) series.add(i * intervalMs, 0);
      return series.staleMs;
    };
    expect(staleMs(50, 20)).toBe(500);
    expect(staleMs(1000, 5)).toBe(3000);
    expect(staleMs(60_000, 5)).toBe(30_000);
    expect(staleMs(50, 1)).toBe(10_000);
    const series = new Series();
    for (let i = 0; i < 5; i++) series.add(i * 50, 0);
    series.clear();
    expect([series.staleMs, series.length, series.at(1e9)]).toEqual([10_000, 0, null]);
  });
});
