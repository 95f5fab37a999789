import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { chooseFrameRate, chooseResolution } from './display-offer.ts';

describe('chooseFrameRate', () => {
  test('takes none where none is offered', () => {
    expect(chooseFrameRate([], 90)).toBe(null);
    expect(chooseFrameRate(undefined, 90)).toBe(null);
    expect(chooseFrameRate([0, Number.NaN, -5], 90)).toBe(null);
  });

  test('whatever is offered, it is one of the rates, and never above the wanted one if any is not', () => {
    const rate = fc.integer({ min: 1, max: 300 });
    fc.assert(
      fc.property(fc.array(rate, { minLength: 1 }), rate, (offered, most) => {
        const chosen = chooseFrameRate(offered, most) as number;
        expect(offered).toContain(chosen);
        const fitting = offered.filter((one) => one <= most);
        expect(chosen).toBe(fitting.length > 0 ? Math.max(...fitting) : Math.min(...offered));
      }),
      { seed: 14 },
    );
  });
});

test('never computes more pixels than the display has, nor fewer than are recommended for that', () => {
  expect(chooseResolution(0.7, 1.4)).toBe(0.7);
  expect(chooseResolution(2, 1.4)).toBe(1.4);
  expect(chooseResolution(1, 0.8)).toBe(1);
  expect(chooseResolution(1.5, 0)).toBe(1.5);
});
