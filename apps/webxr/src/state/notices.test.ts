import { afterEach, beforeEach, describe, expect, test, vi } from 'vitest';
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

describe('what is only mentioned', () => {
  const notices = () => {
    const all = new Notices();
    return { all, shown: () => all.shown.value?.text };
  };

  test('waits until good news has been read', () => {
    const { all, shown } = notices();
    all.tell('Signed in: Ada', 'good');
    all.mention('Connected to Rover');
    vi.advanceTimersByTime(1900);
    expect(shown()).toBe('Signed in: Ada');
    vi.advanceTimersByTime(200);
    expect(shown()).toBe('Connected to Rover');
    vi.advanceTimersByTime(5000);
    expect(shown()).toBeUndefined();
  });

  test('waits for nothing else, and nothing waits for it', () => {
    const { all, shown } = notices();
    all.tell('The robot is busy', 'warning');
    all.mention('Connected to Rover');
    expect(shown()).toBe('Connected to Rover');
    all.tell('Saved', 'good');
    expect(shown()).toBe('Saved');
  });

  test('is not shown after what came later', () => {
    const { all, shown } = notices();
    all.tell('Signed in: Ada', 'good');
    all.mention('Connected to Rover');
    all.tell('The robot is busy', 'warning');
    vi.advanceTimersByTime(4900);
    expect(shown()).toBe('The robot is busy');
    vi.advanceTimersByTime(200);
    expect(shown()).toBeUndefined();
  });
});
