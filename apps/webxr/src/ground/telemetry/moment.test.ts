import { describe, expect, test } from 'vitest';
import { shownAt } from './moment.ts';
import { PresentedInstant } from './presented-instant.ts';
import { Series } from './series.ts';

function speeds(): Series {
  const series = new Series();
  for (let timeMs = 0; timeMs <= 1000; timeMs += 50) series.add(timeMs, timeMs);
  return series;
}

describe('what is shown', () => {
  test('belongs to the instant that is presented, and is otherwise the newest', () => {
    const series = speeds();
    expect(shownAt(series, { instantMs: 880, robotNowMs: 1000, heard: true })).toMatchObject({
      value: 850,
      ageMs: 150,
    });
    expect(shownAt(series, { instantMs: null, robotNowMs: 1000, heard: true })).toMatchObject({
      value: 1000,
      ageMs: 0,
    });
    expect(shownAt(series, { instantMs: -10, robotNowMs: 1000, heard: true })).toMatchObject({ value: 1000 });
    expect(shownAt(new Series(), { instantMs: null, robotNowMs: 0, heard: true })).toBeNull();
    expect(shownAt(undefined, { instantMs: null, robotNowMs: 0, heard: true })).toBeNull();
  });

  test('is stale when its series has stopped, however late the picture is', () => {
    const series = speeds();
    const isStale = (instantMs: number | null, robotNowMs: number) =>
      shownAt(series, { instantMs, robotNowMs, heard: true })?.stale;
    expect(isStale(200, 1000)).toBe(false);
    expect(isStale(null, 1400)).toBe(false);
    expect(isStale(null, 1600)).toBe(true);
    expect(isStale(1580, 1600)).toBe(true);
  });
});

test('the presented instant is the newest that is shown, as long as something new is shown', () => {
  const presented = new PresentedInstant();
  expect(presented.at(0)).toBeNull();
  presented.show(500, 100);
  presented.show(480, 110);
  expect(presented.at(120)).toBe(500);
  expect(presented.at(1099)).toBe(500);
  expect(presented.at(1101)).toBeNull();
  // Another clock, after a pause.
  presented.show(20, 2000);
  expect(presented.at(2001)).toBe(20);
  presented.clear();
  expect(presented.at(2001)).toBeNull();
});

test('a robot that is not heard has no live value', () => {
  const series = new Series();
  series.add(1000, 1);
  const at = { instantMs: null, robotNowMs: 1000 };
  expect(shownAt(series, { ...at, heard: false })?.stale).toBe(true);
  expect(shownAt(series, { ...at, heard: true })?.stale).toBe(false);
});
