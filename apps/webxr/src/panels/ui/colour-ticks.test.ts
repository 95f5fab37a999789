import { COLOUR_MODES } from '@farpoint/cloud-view';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { isValued, ticksOf } from './colour-ticks.ts';

const texts = (min: number, max: number) => ticksOf(min, max).map(({ text }) => text);

describe('ticksOf', () => {
  test('are round numbers', () => {
    expect(texts(0, 2.7)).toEqual(['0', '1', '2']);
    expect(texts(-0.13, 2.2)).toEqual(['0.0', '0.5', '1.0', '1.5', '2.0']);
    expect(texts(3, 47)).toEqual(['10', '20', '30', '40']);
    expect(texts(0, 100)).toEqual(['0', '20', '40', '60', '80', '100'].filter((_, i) => i % 2 === 0));
    expect(texts(1, 1)).toEqual([]);
  });

  test('stand where their values are, and there are one to five', () => {
    const min = fc.double({ min: -100, max: 100, noNaN: true });
    const span = fc.double({ min: 0.01, max: 500, noNaN: true });
    fc.assert(
      fc.property(min, span, (low, width) => {
        const ticks = ticksOf(low, low + width);
        expect(ticks.length).toBeGreaterThanOrEqual(1);
        expect(ticks.length).toBeLessThanOrEqual(5);
        for (const { place, text } of ticks) {
          expect(place).toBeGreaterThanOrEqual(-1e-6);
          expect(place).toBeLessThanOrEqual(1 + 1e-6);
          expect(Math.abs(low + place * width - Number(text))).toBeLessThan(width * 0.01 + 1e-6);
        }
      }),
      { seed: 5 },
    );
  });
});

test('only colours that stand for a value have numbers', () => {
  expect(COLOUR_MODES.filter(isValued)).toEqual(['height', 'distance', 'intensity', 'age']);
});
