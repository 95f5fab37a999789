import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { type Pumped, SendLoop } from './send-loop.ts';

class Sender implements Pumped {
  pumps = 0;
  nextDueMs: number | null = null;

  pump(): void {
    this.pumps++;
    this.nextDueMs = null;
  }
}

beforeEach(() => {
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
});

it('pumps and measures only what is due, and sleeps until something is', () => {
  const loop = new SendLoop(() => Date.now());
  const works: number[] = [];
  loop.onWork = (ms) => works.push(ms);
  const sender = new Sender();
  loop.add(sender);
  loop.run();
  expect([sender.pumps, works.length, vi.getTimerCount()]).toEqual([0, 0, 0]);
  sender.nextDueMs = Date.now() + 7;
  loop.run();
  expect(sender.pumps).toBe(0);
  vi.advanceTimersByTime(7);
  expect([sender.pumps, works.length, vi.getTimerCount()]).toEqual([1, 1, 0]);
});

it('drives every sender when one is due, and none once closed', () => {
  const loop = new SendLoop(() => Date.now());
  const [early, late] = [new Sender(), new Sender()];
  loop.add(early);
  loop.add(late);
  early.nextDueMs = Date.now();
  late.nextDueMs = Date.now() + 5;
  loop.run();
  expect(early.pumps).toBe(1);
  late.nextDueMs = Date.now() + 5;
  loop.run();
  loop.close();
  vi.advanceTimersByTime(50);
  expect(late.pumps).toBe(1);
});
