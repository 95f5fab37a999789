import { stampUsOf } from '@farpoint/protocol';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { SentViews } from './sent-views.ts';

const NOW_MS = 5_000_000;

function setUp() {
  const views = new SentViews();
  /** When what is named was captured; `null` if it was not sent. */
  const named = (capturedMs: number, by = 'a') => {
    const ageMs = views.ageMs(by, stampUsOf(capturedMs), NOW_MS);
    return ageMs === null ? null : NOW_MS - ageMs;
  };
  return { views, named };
}

test('only what was sent can be named, as exactly as its kind permits', () => {
  const { views, named } = setUp();
  const at = NOW_MS - 1000;
  expect([named(at), views.ageMs('a', undefined, NOW_MS)]).toEqual([null, null]);
  views.sent('a', at);
  views.sent('a', at + 25, 50);
  expect([named(at + 0.4), named(at - 1)]).toEqual([at, at]);
  expect([named(at + 60), named(at - 10)]).toEqual([at + 25, at + 25]);
  expect([named(at + 80), named(at - 100), named(NOW_MS - 90)]).toEqual([null, null, null]);
});

test('what was sent to another, or in a session that has ended, was not seen', () => {
  const { views, named } = setUp();
  views.sent('b', NOW_MS - 10);
  expect([named(NOW_MS - 10), named(NOW_MS - 10, 'b')]).toEqual([null, NOW_MS - 10]);
  views.forget('b');
  expect(named(NOW_MS - 10, 'b')).toBeNull();
});

test('what was sent long ago is forgotten, however much was', () => {
  fc.assert(
    fc.property(fc.integer({ min: 1, max: 3000 }), (count) => {
      const { views, named } = setUp();
      for (let i = 0; i < count; i++) views.sent('a', NOW_MS - 40_000 + i * 10);
      expect(named(NOW_MS - 40_000 + (count - 1) * 10)).toBe(NOW_MS - 40_000 + (count - 1) * 10);
      expect(named(NOW_MS - 40_000)).toBe(count <= 512 ? NOW_MS - 40_000 : null);
    }),
    { seed: 7, numRuns: 50 },
  );
});

test('memory is bounded', () => {
  const { views, named } = setUp();
  for (let i = 0; i < 200; i++) views.sent(`operator ${i}`, NOW_MS - 10);
  expect([named(NOW_MS - 10, 'operator 0'), named(NOW_MS - 10, 'operator 199')]).toEqual([null, NOW_MS - 10]);
});
