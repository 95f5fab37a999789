import { expect, test } from 'vitest';
import { ProbePlan } from './probe-plan.ts';

/** The wait until the next train is due, ms, long after any overuse. */
function waitMs(plan: ProbePlan, fromMs: number): number {
  for (let ms = 0; ms < 20_000; ms += 10)
    if (plan.isDue(Number.POSITIVE_INFINITY, false, fromMs + ms)) return ms;
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
