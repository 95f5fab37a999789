import { afterEach, beforeEach, expect, test, vi } from 'vitest';
import { Notices } from './notices.ts';

beforeEach(() => vi.useFakeTimers());
afterEach(() => vi.useRealTimers());

test('hides a line five seconds after it was last told', () => {
  const notices = new Notices();
  expect(notices.shown.value).toBe(null);
  notices.tell('hello');
  vi.advanceTimersByTime(4000);
  notices.tell('hello', 'warning');
  vi.advanceTimersByTime(4000);
  expect(notices.shown.value).toEqual({ text: 'hello', tone: 'warning' });
  vi.advanceTimersByTime(1000);
  expect(notices.shown.value).toBe(null);
  expect(notices.last.value?.text).toBe('hello');
  notices.tell('again');
  expect(notices.shown.value).toEqual({ text: 'again', tone: 'neutral' });
});
