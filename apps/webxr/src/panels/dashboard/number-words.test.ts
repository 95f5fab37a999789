import { expect, test } from 'vitest';
import { ageText, fixText, spanText, withUnit } from './number-words.ts';

test('numbers have as many digits as say something, and their unit', () => {
  expect(withUnit(0.5234, 'm/s')).toBe('0.52 m/s');
  expect(withUnit(-0.0001, 'm/s')).toBe('0.00 m/s');
  expect(withUnit(87.4, '°')).toBe('87°');
  expect(withUnit(81.6, '%')).toBe('82 %');
  expect(withUnit(1234.567, 'Pa')).toBe('1235 Pa');
  expect(withUnit(1.23456, 'rad')).toBe('1.235 rad');
  expect(withUnit(2.5e-7, '')).toBe('2.50e-7');
  expect(withUnit(0, 'x')).toBe('0 x');
  expect(fixText(48.1371541, 11.5)).toBe('48.137154°, 11.500000°');
});

test('ages and spans are short', () => {
  expect([40, 999, 1500, 12_000, 119_000, 180_000, 7_300_000].map(ageText)).toEqual([
    ...['40 ms', '1000 ms', '1.5 s', '12 s', '119 s', '3 min', '2 h'],
  ]);
  expect([30, 120, 3600].map(spanText)).toEqual(['30 s', '2 min', '1 h']);
});
