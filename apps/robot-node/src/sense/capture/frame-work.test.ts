import { expect, it } from 'vitest';
import { workOf } from './frame-capture.ts';

it('counts the clock’s time for a source that has its own timing', () => {
  expect(workOf(20, 8, false)).toBe(20);
});

it('counts processor time for a source that is asked, until most of the time is waiting', () => {
  expect(workOf(10, 8, true)).toBe(8);
  expect(workOf(40, 8, true)).toBe(30);
});
