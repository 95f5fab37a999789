import { afterEach, expect, test } from 'vitest';
import { speak } from './language.ts';
import { dateText, fixed, grouped, marked, percent } from './numbers.ts';

afterEach(() => speak('en'));

test('English writes a decimal point, and commas between thousands', () => {
  expect([fixed(0.384, 2), marked('1.5'), grouped(12_000), percent(0.254)]).toEqual([
    '0.38',
    '1.5',
    '12,000',
    '25 %',
  ]);
});

test('German writes a decimal comma, and points between thousands', async () => {
  await speak('de');
  expect([fixed(0.384, 2), fixed(-7, 0), marked('1.5'), grouped(12_000)]).toEqual([
    '0,38',
    '-7',
    '1,5',
    '12.000',
  ]);
});

test('dates are written as the language writes them', async () => {
  const noon = Date.UTC(2026, 2, 5, 12);
  expect(dateText(noon)).toContain('Mar');
  await speak('de');
  expect(dateText(noon)).toContain('05.03.2026');
});
