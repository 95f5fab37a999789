import fc from 'fast-check';
import { expect, test } from 'vitest';
import { PressTwice } from './press-twice.ts';

test('nothing is done without two presses of the same, between 0.3 and 3 s apart', () => {
  const presses = fc.array(fc.tuple(fc.constantFrom('a', 'b'), fc.integer({ min: 0, max: 4000 })));
  fc.assert(
    fc.property(presses, (all) => {
      const twice = new PressTwice();
      let nowMs = 0;
      let earlier: [string, number][] = [];
      for (const [id, gapMs] of all) {
        nowMs += gapMs;
        if (twice.press(id, nowMs)) {
          const first = earlier.find(
            ([other, atMs]) => other === id && nowMs - atMs >= 300 && nowMs - atMs < 3000,
          );
          expect(first).toBeDefined();
          earlier = [];
        } else earlier.push([id, nowMs]);
      }
    }),
    { seed: 1, numRuns: 300 },
  );
});

test('the second press confirms until three seconds after the first, unless something else came between', () => {
  const twice = new PressTwice();
  expect([twice.press('a', 0), twice.press('a', 299), twice.armed(2999), twice.press('a', 2999)]).toEqual([
    ...[false, false, 'a', true],
  ]);
  expect([twice.press('a', 3000), twice.armed(5999), twice.armed(6000), twice.press('a', 6000)]).toEqual([
    ...[false, 'a', null, false],
  ]);
  twice.forget();
  expect(twice.press('a', 7000)).toBe(false);
});
