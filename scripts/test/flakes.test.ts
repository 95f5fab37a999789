import { describe, expect, it } from 'vitest';
import { countFlakes, flakeLines } from './flakes.ts';
import type { StepSummary } from './summary.ts';
import type { Judged } from './verdict.ts';

const judged = (title: string, verdict: Judged['verdict'], reason = ''): Judged => ({
  ...{ file: 'a.test.ts', title, status: verdict === 'passed' ? 'passed' : 'failed', verdict },
  ...{ ms: 1, reason, line: null, attachments: [], alone: [] },
});
const step = (name: string, tests: Judged[], ok = true): StepSummary => ({
  ...{ name, ms: 1, ok, judged: tests, failure: null, notTested: [], proven: [] },
});
const passed = (count: number) => Array.from({ length: count }, (_, n) => judged(`passes ${n}`, 'passed'));

describe('repeated runs', () => {
  it('count each test’s failures at first and after the rerun', () => {
    const { tests } = countFlakes([
      [step('stack', [judged('a', 'flaky', 'late\nstack'), judged('b', 'failed')], false)],
      [step('stack', [judged('a', 'passed'), judged('b', 'flaky')])],
    ]);
    expect(tests.map(({ test, tries, first, afterRerun }) => [test, tries, first, afterRerun])).toEqual([
      ['a.test.ts > b', 2, 2, 1],
      ['a.test.ts > a', 2, 1, 0],
    ]);
    expect(tests[1]?.reason).toBe('late');
  });

  it.each<[string, number, Judged[], boolean]>([
    ['pure', 5000, [], true],
    ['pure', 5000, [judged('a', 'failed')], false],
    ['scenario', 5000, [judged('a', 'failed')], false],
    ['page', 5000, [judged('a', 'failed')], false],
    ['stack', 1999, [judged('a', 'flaky')], true],
    ['stack', 1000, [judged('a', 'flaky')], false],
    ['stack', 5000, [judged('a', 'failed')], false],
    ['smoke', 99, [judged('a', 'flaky')], true],
    ['smoke', 50, [judged('a', 'flaky')], false],
    ['smoke', 999, [judged('a', 'failed')], false],
    ['smoke', 1, [judged('a', 'quarantined')], true],
  ])('%s: %i passes and %j', (name, passes, others, ok) => {
    const failed = others.some(({ verdict }) => verdict === 'failed');
    expect(countFlakes([[step(name, [...passed(passes), ...others], !failed)]]).ok).toBe(ok);
  });

  it('a step that fails without a test is over every budget', () => {
    expect(countFlakes([[step('smoke', passed(10), false)]]).ok).toBe(false);
    expect(countFlakes([[step('lint', [])], [step('lint', [], false)]]).ok).toBe(false);
  });

  it('end with a table', () => {
    const lines = flakeLines(countFlakes([[step('stack', [...passed(3), judged('a', 'flaky')])]]));
    expect(lines).toEqual([
      '✗ stack      4 tries  1 failed at first (25 %, budget 0.05 %)  0 after the rerun (budget 0 %)',
      '',
      'first  after  of  step   test',
      '    1      0   1  stack  a.test.ts > a',
    ]);
    expect(flakeLines(countFlakes([[step('pure', passed(1))]]))).toContain('no test has failed');
  });
});
