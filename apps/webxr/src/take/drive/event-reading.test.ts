import { expect, test } from 'vitest';
import { EventReading } from './event-reading.ts';

test('what is down counts as read while the page runs', () => {
  const reading = new EventReading();
  reading.runs(0);
  for (let now = 25; now <= 500; now += 25) {
    reading.runs(now);
    expect(reading.readMs).toBe(now);
  }
});

test('after a hitch the events that wait come first: the next turn counts', () => {
  const reading = new EventReading();
  for (let now = 0; now <= 500; now += 25) reading.runs(now);
  reading.runs(801);
  expect(reading.readMs).toBe(500);
  // The key was let go meanwhile, and the page hears of it now.
  reading.told(802);
  expect(reading.readMs).toBe(802);
  reading.runs(826);
  expect(reading.readMs).toBe(826);
});
