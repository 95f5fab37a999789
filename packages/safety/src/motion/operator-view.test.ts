import fc from 'fast-check';
import { expect, test } from 'vitest';
import { OperatorView } from './operator-view.ts';

test('nothing is known at first, nor of a picture from the future, nor after the driver has changed', () => {
  const view = new OperatorView();
  expect([view.ageMs(0), view.worstAgeMs(0)]).toEqual([null, null]);
  for (const age of [null, -50, Number.NaN]) view.note(age, 10);
  expect(view.ageMs(10)).toBe(null);
  view.note(80, 20);
  expect(view.ageMs(20)).toBe(80);
  view.forget();
  expect([view.ageMs(30), view.worstAgeMs(30)]).toEqual([null, null]);
});

test('the age grows until a newer picture is seen; an older one changes nothing', () => {
  const view = new OperatorView();
  view.note(100, 1000);
  expect(view.ageMs(1200)).toBe(300);
  view.note(500, 1200);
  expect(view.ageMs(1200)).toBe(300);
  view.note(90, 1200);
  expect(view.ageMs(1210)).toBe(100);
});

test('the worst age of the last second is remembered, and then forgotten', () => {
  const view = new OperatorView();
  view.note(50, 0);
  view.note(50, 350);
  expect(view.worstAgeMs(360)).toBe(400);
  for (let t = 400; t <= 2000; t += 50) view.note(50, t);
  expect(view.worstAgeMs(2000)).toBe(100);
});

test('what is not even taken is overdue before the driver can miss it', () => {
  const view = new OperatorView();
  // On a link that takes 300 ms.
  for (let t = 0; t <= 3000; t += 30) {
    view.supplied(t);
    if (t >= 300) view.note(300, t);
  }
  for (let t = 3010; t <= 3200; t += 30) view.note(300, t);
  expect(view.unsuppliedMs(3200)).toBe(170);
  expect(view.unseenMs(3200)).toBeLessThanOrEqual(0);
  // Nor does it count for the next driver.
  view.forget();
  view.note(300, 3200);
  expect(view.unsuppliedMs(3250)).toBe(Number.NEGATIVE_INFINITY);
  expect(view.unseenMs(3250)).toBe(-50);
});

test('a rate at which less is taken is no fault for longer than once', () => {
  const view = new OperatorView();
  for (let t = 0; t <= 3000; t += 30) {
    view.supplied(t);
    view.note(50, t);
  }
  for (let t = 3400; t <= 6000; t += 400) {
    view.supplied(t);
    view.note(50, t);
    expect(Math.max(view.unsuppliedMs(t + 399), view.unseenMs(t + 399))).toBeLessThanOrEqual(0);
  }
});

test('whatever is noted, the worst age is at least the present one, and neither is below 0', () => {
  const steps = fc.array(
    fc.record({ waitMs: fc.integer({ min: 0, max: 900 }), ageMs: fc.integer({ min: -5, max: 5000 }) }),
    { maxLength: 60 },
  );
  fc.assert(
    fc.property(steps, (all) => {
      const view = new OperatorView();
      let now = 10_000;
      let newest = Number.NEGATIVE_INFINITY;
      for (const { waitMs, ageMs } of all) {
        now += waitMs;
        view.note(ageMs, now);
        if (ageMs >= -2) newest = Math.max(newest, now - ageMs);
        const age = view.ageMs(now);
        expect(age ?? Number.POSITIVE_INFINITY).toBeCloseTo(now - newest, 6);
        expect(view.worstAgeMs(now) ?? Number.POSITIVE_INFINITY).toBeGreaterThanOrEqual(
          age ?? Number.NEGATIVE_INFINITY,
        );
      }
    }),
    { seed: 19 },
  );
});
