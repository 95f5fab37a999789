import fc from 'fast-check';
import { expect, test } from 'vitest';
import { wrapText } from './wrapped-text.ts';

const measure = (text: string) => text.length;

test('breaks between words, and within a word only if it is wider than a row', () => {
  expect(wrapText('Let go of it, then drive.', 12, measure)).toEqual(['Let go of', 'it, then', 'drive.']);
  expect(wrapText('a Donaudampfschiff b', 6, measure)).toEqual(['a', 'Donaud', 'ampfsc', 'hiff b']);
  expect(wrapText('', 6, measure)).toEqual([]);
});

test('no row is wider than asked for, and no letter is lost', () => {
  fc.assert(
    fc.property(fc.string({ maxLength: 200 }), fc.integer({ min: 1, max: 40 }), (text, width) => {
      const rows = wrapText(text, width, measure);
      expect(rows.every((row) => row.length <= width)).toBe(true);
      expect(rows.join('').replaceAll(' ', '')).toBe(text.replaceAll(' ', ''));
    }),
  );
});
