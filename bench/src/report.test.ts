import { expect, test } from 'vitest';
import { formatTable, numberOption } from './report.ts';

test('a table aligns its columns, with numbers to the right', () => {
  expect(
    formatTable(
      ['what', 'ms', 'points'],
      [
        ['sample', 0.71239, 230_400],
        ['a longer name', 12.5, null],
      ],
    ),
  ).toBe(
    [
      'what               ms   points',
      '-------------  ------  -------',
      'sample         0.7124  230,400',
      'a longer name   12.50        –',
    ].join('\n'),
  );
});

test('a number option says which one is wrong', () => {
  expect(numberOption('points', '30000')).toBe(30_000);
  expect(() => numberOption('points', 'many')).toThrow('--points is `many`, not a number of at least 0');
  expect(() => numberOption('rate', '-1')).toThrow('--rate');
  expect(() => numberOption('rate', '')).toThrow('--rate');
});
