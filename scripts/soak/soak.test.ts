import { describe, expect, it } from 'vitest';
import { farFromMedians, figuresIn, median, withNewest } from './figures.ts';
import { PARTS, planSoak, stepsOf } from './plan.ts';
import { readRecord } from './record.ts';
import { expiredQuarantine, type PartResult, resultsPage } from './results.ts';

const names = (parts: readonly { name: string }[]) => parts.map(({ name }) => name);
const part = (name: string) => PARTS.find((each) => each.name === name) as (typeof PARTS)[number];

describe('the plan', () => {
  it('has all parts, some of them, or all but some', () => {
    expect(planSoak([], [])).toEqual(PARTS);
    expect(names(planSoak(['mutants', 'quarantine'], []))).toEqual(['quarantine', 'mutants']);
    expect(names(planSoak([], ['all', 'load']))).not.toContain('all');
  });

  it('says which part there is not, and when none is left', () => {
    expect(() => planSoak(['mutant'], [])).toThrow('there is no part mutant; the parts are quarantine, all,');
    expect(() => planSoak([], ['alle'])).toThrow('there is no part alle');
    expect(() => planSoak(['all'], ['all'])).toThrow('no part is left');
  });

  it('leaves out what has no step yet', () => {
    expect(stepsOf(part('scenarios'), ['pure', 'stack'])).toBeNull();
    expect(stepsOf(part('scenarios'), ['scenario'])).toEqual(['scenario']);
    expect(stepsOf(part('load'), ['lint', 'pure', 'stack'])).toEqual(['pure', 'stack']);
    expect(stepsOf(part('mutants'), [])).toEqual([]);
  });

  it('runs layers under load, all cases with the seed, and scenarios with a log for each time', () => {
    expect(part('load').commands(['pure', 'stack'], 7)[0]?.args.join(' ')).toBe(
      'scripts/test.ts --only pure,stack --repeat 3 --load 2',
    );
    expect(part('properties').commands([], 7)[0]?.env).toMatchObject({
      FAST_CHECK_SEED: '7',
      FARPOINT_LONG_TESTS: '1',
    });
    const logs = part('scenarios')
      .commands(['scenario'], 7)
      .map(({ env }) => env?.FARPOINT_EVENT_LOGS);
    expect(logs).toEqual(part('scenarios').equalLogs);
    expect(new Set(logs).size).toBe(2);
  });
});

describe('figures', () => {
  it('are the numbers of the last JSON object, by their paths', () => {
    expect(figuresIn('{"a":1}\ntext\n{"b":{"p95":2,"name":"x","list":[3]},"c":null}\n')).toEqual({
      ...{ 'b.p95': 2, 'b.list.0': 3 },
    });
    expect(figuresIn('nothing')).toEqual({});
    expect(figuresIn('{broken')).toEqual({});
  });

  it('that are far from their median are named, from the third soak on', () => {
    const earlier = [{ ms: 10 }, { ms: 100 }, { ms: 12 }];
    expect(farFromMedians({ ms: 14 }, earlier)).toEqual([]);
    expect(farFromMedians({ ms: 16, other: 5 }, earlier)).toEqual(['ms 16 (median 12)']);
    expect(farFromMedians({ ms: 16 }, earlier.slice(1))).toEqual([]);
  });

  it('of the last nine soaks are kept', () => {
    const many = Array.from({ length: 9 }, (_, n) => ({ ms: n }));
    expect(withNewest(many, { ms: 9 }).map(({ ms }) => ms)).toEqual([1, 2, 3, 4, 5, 6, 7, 8, 9]);
    expect([median([3, 1, 2]), median([4, 1, 2, 3])]).toEqual([2, 2.5]);
  });
});

const result = (name: string, more: Partial<PartResult> = {}): PartResult => ({
  ...{ name, what: `what ${name} is`, outcome: 'passed', ms: 65_000, words: '', lastLines: [], ...more },
});

it('a soak that goes on keeps what has passed of the same commit', () => {
  const results = [result('all'), result('load', { outcome: 'failed', lastLines: ['no'] })];
  const text = JSON.stringify({ commit: 'a1', seed: 7, results });
  expect(readRecord(text, 'a1')).toEqual({ commit: 'a1', seed: 7, results: [result('all')] });
  expect(readRecord(text, 'b2')).toBe('the last soak was of a1');
  expect(readRecord(text, null)).toBe('the tree has uncommitted changes');
  expect(readRecord(null, 'a1')).toBe('no soak has run here');
  for (const broken of ['{', '{"commit":"a1"}'])
    expect(readRecord(broken, 'a1')).toBe('what the last soak has left cannot be read');
});

describe('the page of results', () => {
  const SOAK = { commit: '0123abcdef', seed: 7, at: new Date('2026-11-29T03:04:05Z') };

  it('says of each part how it ended', () => {
    const left = result('scenarios', { outcome: 'left out', ms: 0, words: 'there is no step scenario' });
    const page = resultsPage([result('all', { words: '9 passed' }), left], SOAK);
    expect(page.split('\n')).toEqual([
      ...[
        '# Soak of 2026-11-29 03:04 UTC',
        '',
        'Everything passed, in 1 min 5 s. Commit 0123abcd, seed 7.',
        '',
        '```',
      ],
      '✓ all        1 min 5 s  9 passed',
      '– scenarios        0 s  there is no step scenario',
      ...['```', ''],
    ]);
  });

  it('ends with the last lines of what failed, and fits on a page', () => {
    const lastLines = Array.from({ length: 90 }, (_, n) => `line ${n} ${'x'.repeat(200)}`);
    const page = resultsPage(
      PARTS.map(({ name }) => result(name, name === 'all' ? { outcome: 'failed', lastLines } : {})),
      SOAK,
    ).split('\n');
    expect(page[2]).toContain(`1 of ${PARTS.length} parts failed: all, in `);
    expect(page.length).toBeLessThan(60);
    expect(Math.max(...page.map((line) => line.length))).toBeLessThanOrEqual(140);
    expect(page.at(-3)).toContain('line 89');
  });
});

it('a quarantine that has expired is named', () => {
  const entry = (until: string) => ({
    ...{ test: `a.test.ts > ${until}`, since: '2026-11-20', until, cause: '', seen: '', ends: '' },
  });
  const now = Date.parse('2026-11-29T12:00:00Z');
  expect(expiredQuarantine([entry('2026-11-27'), entry('2026-11-29')], now)).toEqual([
    'a.test.ts > 2026-11-27: expired 2 days ago: mend it or delete it',
  ]);
});
