import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { KeptChild } from './kept-child.ts';

beforeEach(() => void vi.useFakeTimers());
afterEach(() => void vi.useRealTimers());

function bench() {
  const closed: number[] = [];
  let started = 0;
  const kept = new KeptChild(
    () => {
      const number = ++started;
      return { number, close: async () => void closed.push(number) };
    },
    { firstMs: 100, mostMs: 400 },
    () => 0.5,
  );
  kept.start();
  return { kept, closed };
}

it('starts another child after a wait that grows', () => {
  const { kept } = bench();
  for (const [i, waitMs] of [100, 200, 400, 400].entries()) {
    expect(kept.onEnd(true)).toBe(true);
    expect(kept.child).toBe(null);
    vi.advanceTimersByTime(waitMs - 1);
    expect(kept.starts).toBe(i + 1);
    vi.advanceTimersByTime(1);
    expect(kept.starts).toBe(i + 2);
  }
});

it('waits briefly again after a child that has worked', () => {
  const { kept } = bench();
  kept.onEnd(true);
  vi.advanceTimersByTime(100);
  vi.advanceTimersByTime(10_001);
  kept.onEnd(true);
  vi.advanceTimersByTime(100);
  expect(kept.starts).toBe(3);
});

it('starts none where that cannot help, and none after it was closed', async () => {
  const { kept } = bench();
  kept.onEnd(false);
  vi.advanceTimersByTime(100_000);
  expect(kept.starts).toBe(1);
  const { kept: other, closed } = bench();
  await other.close();
  expect(closed).toEqual([1]);
  expect(other.onEnd(true)).toBe(false);
  vi.advanceTimersByTime(100_000);
  expect(other.starts).toBe(1);
});
