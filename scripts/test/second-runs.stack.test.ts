import { stripVTControlCharacters } from 'node:util';
import { expect, it } from 'vitest';
import { run } from '../lib/run.ts';
import { namePattern } from './second-runs.ts';

it('vitest finds the tests that are to run again, and no others', { timeout: 60_000 }, async () => {
  const titles = [
    'what failed is run again alone > of a long file, only the tests that failed',
    'what failed is run again alone > but not a great number of tests',
    'no such test (it.each)',
  ];
  const file = 'scripts/test/second-runs.test.ts';
  const { output } = await run('vitest', ['run', '--project', 'pure', file, '-t', namePattern(titles)]);
  expect(stripVTControlCharacters(output)).toMatch(/Tests +2 passed \| \d+ skipped/);
});
