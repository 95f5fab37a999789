import fc from 'fast-check';
import { expect, test } from 'vitest';
import { OperatorView } from './operator-view.ts';

const PAUSE_MS = 150;

/** Commands that name the same picture, every 50 ms. @param capturedMs when it was captured */
function repeats(view: OperatorView, capturedMs: number, fromMs: number, toMs: number): void {
  for (let t = fromMs; t <= toMs; t += 50) view.note(t - capturedMs, t);
}

test('nothing is known at first, nor of a picture from the future, nor after the driver has changed', () => {
  const view = new OperatorView(PAUSE_MS);
  expect([view.ageMs(0), view.worstAgeMs(0)]).toEqual([null, null]);
  for (const age of [null, -50, Number.NaN]) view.note(age, 10);
  expect(view.ageMs(10)).toBe(null);
  view.note(80, 20);
  expect(view.ageMs(20)).toBe(80);
  view.forget();
  expect([view.ageMs(30), view.worstAgeMs(30)]).toEqual([null, null]);
});

test('the age grows until a newer picture is seen; an older one changes nothing', () => {
  const view = new OperatorView(PAUSE_MS);
  repeats(view, 900, 1000, 1150);
  expect(view.ageMs(1200)).toBe(300);
  view.note(500, 1200);
  expect(view.ageMs(1200)).toBe(300);
  view.note(90, 1200);
  expect(view.ageMs(1210)).toBe(100);
});

test('the worst age of the last second is remembered, and then forgotten', () => {
  const view = new OperatorView(PAUSE_MS);
  view.note(50, -50);
  repeats(view, -50, 0, 300);
  view.note(50, 350);
  expect(view.worstAgeMs(360)).toBe(400);
  for (let t = 400; t <= 2000; t += 50) view.note(50, t);
  expect(view.worstAgeMs(2000)).toBe(100);
});

test('while no command comes nothing is known, and the first one after a pause starts anew', () => {
  for (const pauseMs of [151, 300, 10_000, 3_600_000]) {
    const view = new OperatorView(PAUSE_MS);
    for (let t = 0; t <= 2000; t += 25) view.note(60, t);
    expect([view.ageMs(2150), view.worstAgeMs(2150)]).toEqual([210, 210]);
    expect([view.ageMs(2000 + pauseMs), view.worstAgeMs(2000 + pauseMs)]).toEqual([null, null]);
    const backMs = 2000 + pauseMs;
    view.note(60, backMs);
    expect([view.ageMs(backMs), view.worstAgeMs(backMs), view.overdueMs(backMs)]).toEqual([60, 60, -100]);
  }
});

test('a picture that was shown through a pause counts as old as it is, as long as nothing newer is seen', () => {
  const view = new OperatorView(PAUSE_MS);
  for (let t = 0; t <= 2000; t += 25) view.note(60, t);
  // The page hangs for 300 ms, and draws again 50 ms later.
  repeats(view, 1940, 2300, 2350);
  expect([view.ageMs(2350), view.worstAgeMs(2350)]).toEqual([410, 410]);
  view.note(60, 2375);
  expect(view.worstAgeMs(2375)).toBe(60);
  view.note(60, 2400);
  expect(view.worstAgeMs(2400)).toBe(85);
});

test('a page that hangs with its commands going on is found out, however long it does', () => {
  const view = new OperatorView(PAUSE_MS);
  for (let t = 0; t <= 60_000; t += 25) view.note(60 + t, t);
  expect(view.ageMs(60_000)).toBe(60_060);
});

test('what is not even sent is overdue before the driver can miss it', () => {
  const view = new OperatorView(PAUSE_MS);
  // On a link that takes 300 ms.
  for (let t = 0; t <= 3000; t += 30) {
    view.sent(t);
    if (t >= 300) view.note(300, t);
  }
  for (let t = 3010; t <= 3200; t += 30) view.note(300, t);
  expect(view.overdueMs(3200)).toBe(170);
  // Nor does it count for the next driver.
  view.forget();
  view.note(300, 3200);
  expect(view.overdueMs(3250)).toBe(-50);
});

test('a rate at which less is sent is no fault for longer than once', () => {
  const view = new OperatorView(PAUSE_MS);
  for (let t = 0; t <= 3000; t += 30) {
    view.sent(t);
    view.note(50, t);
  }
  for (let t = 3400; t <= 6000; t += 400) {
    repeats(view, t - 450, t - 350, t - 50);
    view.sent(t);
    view.note(50, t);
    if (t > 3400) expect(view.overdueMs(t + 399)).toBeLessThanOrEqual(0);
  }
});

test('whatever is noted, the worst age is at least the present one, and neither is below 0', () => {
  const steps = fc.array(
    fc.record({ waitMs: fc.integer({ min: 0, max: 900 }), ageMs: fc.integer({ min: -5, max: 5000 }) }),
    { maxLength: 60 },
  );
  fc.assert(
    fc.property(steps, (all) => {
      const view = new OperatorView(PAUSE_MS);
      let now = 10_000;
      let newest = Number.NEGATIVE_INFINITY;
      for (const { waitMs, ageMs } of all) {
        now += waitMs;
        if (waitMs > PAUSE_MS) newest = Number.NEGATIVE_INFINITY;
        view.note(ageMs, now);
        if (ageMs >= -2) newest = Math.max(newest, now - ageMs);
        const age = view.ageMs(now);
        expect(age ?? Number.POSITIVE_INFINITY).toBeCloseTo(now - newest, 6);
        if (age !== null) expect(view.worstAgeMs(now)).toBeGreaterThanOrEqual(age);
        expect([view.ageMs(now + PAUSE_MS + 1), view.worstAgeMs(now + PAUSE_MS + 1)]).toEqual([null, null]);
      }
    }),
    { seed: 19 },
  );
});
