import { expect, test } from 'vitest';
import { formatTable } from './report.ts';

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
