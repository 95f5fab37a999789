import { expect, test } from 'vitest';
import * as schema from './option-schemas.ts';

const size = schema.size({ min: 1000, none: true });

test.each([
  ['500MB', 500e6],
  ['4 GB', 4e9],
  ['4g', 4e9],
  ['1.5kb', 1500],
  ['2000', 2000],
  [4e9, 4e9],
  ['none', Number.POSITIVE_INFINITY],
])('%j is %d bytes', (given, bytes) => {
  expect(size.parse(given)).toBe(bytes);
});

test.each(['', 'much', '12XB', '-4GB', '999', null, [], {}, true, Number.NaN, '1e9'])(
  'refuses %j',
  (given) => {
    const { success, error } = size.safeParse(given);
    expect(success).toBe(false);
    expect(error?.issues[0]?.message).toMatch(/^must be a size such as 500MB or 4GB.*or none$/);
  },
);
