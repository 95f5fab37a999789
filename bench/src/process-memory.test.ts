import { expect, test } from 'vitest';
import { pssBytes } from './process-memory.ts';

test('reads the proportional set size', () => {
  const rollup =
    '55d0-7ffe ---p 00000000 00:00 0 [rollup]\nRss:  9000 kB\nPss:     1500 kB\nPss_Dirty:  8 kB\n';
  expect(pssBytes(rollup)).toBe(1500 * 1024);
  expect(pssBytes('')).toBe(0);
});
