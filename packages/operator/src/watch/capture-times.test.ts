import { expect, test } from 'vitest';
import { CaptureTimes } from './capture-times.ts';

test('knows the newest frames by their timestamps, and forgets the oldest', () => {
  const times = new CaptureTimes();
  for (let frame = 0; frame < 200; frame++) times.note(frame * 3000, frame * 33);
  expect(times.of(199 * 3000)).toBe(199 * 33);
  expect(times.of(100 * 3000)).toBe(100 * 33);
  expect(times.of(0)).toBe(null);
  expect(times.of(1)).toBe(null);
});

test('takes a timestamp that comes again as a new frame', () => {
  const times = new CaptureTimes();
  times.note(0, 1);
  for (let frame = 1; frame < 128; frame++) times.note(frame, frame);
  times.note(0, 1000);
  times.note(128, 128);
  expect(times.of(0)).toBe(1000);
  expect(times.of(1)).toBe(null);
});
