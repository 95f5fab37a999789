import { expect, test } from 'vitest';
import { ProbePlan } from './probe-plan.ts';

/** The wait until the next train is due, ms, long after any overuse. */
function waitMs(plan: ProbePlan, fromMs: number, idle = false): number {
  for (let ms = 0; ms < 20_000; ms += 10)
    if (plan.isDue(Number.POSITIVE_INFINITY, idle, fromMs + ms)) return ms;
  return Number.POSITIVE_INFINITY;
}

test('trains that their own queue ends become rare, like those that find nothing', () => {
  const plan = new ProbePlan();
  plan.onOveruse(1);
  const waits: number[] = [];
  let now = 10_000;
  for (let i = 0; i < 5; i++) {
    plan.onAsked(now);
    plan.onCut(now);
    const wait = waitMs(plan, now);
    waits.push(wait);
    now += wait;
  }
  expect(waits).toEqual([500, 1000, 1400, 1400, 1400]);
});

test('the search continues after a train that was cut off', () => {
  const plan = new ProbePlan();
  plan.onAsked(0);
  plan.onCut(0);
  expect(waitMs(plan, 0)).toBe(0);
});

test('a deep cut of the rate triggers the next train soon', () => {
  const plan = new ProbePlan();
  plan.onOveruse(1);
  for (let i = 0; i < 5; i++) plan.onCut(0);
  plan.onOveruse(0.3);
  expect(waitMs(plan, 0)).toBe(250);
});

test('while the source uses little, trains that find a limit become rare, and one that finds none begins anew', () => {
  const plan = new ProbePlan();
  plan.onOveruse(1);
  const after = (sent: number, arrived: number) => {
    plan.onAsked(10_000);
    plan.onOutcome({ sentBitsPerSecond: sent * 1e6, arrivedBitsPerSecond: arrived * 1e6 }, 40e6, 0, 10_000);
    return waitMs(plan, 10_000, true);
  };
  expect([after(60, 40), after(60, 40), after(60, 40), after(60, 40)]).toEqual([2000, 4000, 5000, 5000]);
  expect(after(60, 60)).toBe(1000);
});
