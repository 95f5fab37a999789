import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { fitText } from './fitted-text.ts';

/** Letters half as wide as high. */
const measure = (text: string, size: number) => (text.length * size) / 2;
const fit = (text: string) => fitText(text, 30, 300, measure);

describe('fitText', () => {
  test('keeps a text that fits as it is', () => {
    expect(fit('Stationary')).toEqual({ rows: ['Stationary'], size: 30 });
    expect(fit('')).toEqual({ rows: [''], size: 30 });
  });

  test('makes the letters of one that nearly fits smaller', () => {
    expect(fit('The battery is low (15 %)')).toEqual({ rows: ['The battery is low (15 %)'], size: 24 });
  });

  test('breaks a longer one into two rows, between words', () => {
    expect(fit('⚠ The battery is low (15 %, limit 20 %)')).toEqual({
      rows: ['⚠ The battery is low (15 %,', 'limit 20 %)'],
      size: 19,
    });
  });

  test('says that something is left out', () => {
    expect(fit('a very long sentence that nobody could ever read on a wrist').rows).toEqual([
      'a very long sentence that',
      'nobody could ever read on a wr…',
    ]);
    expect(fit('x'.repeat(50)).rows).toEqual([`${'x'.repeat(30)}…`]);
  });

  test('never exceeds the width', () => {
    fc.assert(
      fc.property(fc.string({ maxLength: 200 }), (text) => {
        const { rows, size } = fit(text);
        expect(rows.length).toBeLessThanOrEqual(2);
        for (const row of rows) expect(measure(row, size)).toBeLessThanOrEqual(300);
      }),
    );
  });
});
