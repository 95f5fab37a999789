import { describe, expect, it } from 'vitest';
import type { Outcome } from './outcome.ts';
import type { Quarantined } from './quarantine.ts';
import { judge, toRunAgain } from './verdict.ts';

const outcome = (title: string, status: Outcome['status']): Outcome => ({
  ...{ file: 'a.spec.ts', title, status, ms: 1, reason: '', line: 1, attachments: [] },
});
const entry = (title: string): Quarantined => ({
  test: `a.spec.ts > ${title}`,
  ...{ since: '2026-11-28', until: '2026-12-05', cause: '', seen: '', ends: '' },
});
const verdictOf = (status: Outcome['status'], alone: Outcome['status'][], quarantine: Quarantined[] = []) =>
  judge(
    [outcome('t', status)],
    alone.map((each) => outcome('t', each)),
    quarantine,
  )[0]?.verdict;

describe('a test that failed', () => {
  it.each([
    [['passed', 'passed'], 'flaky'],
    [['passed', 'failed'], 'failed'],
    [['failed', 'passed'], 'failed'],
    [['failed', 'failed'], 'failed'],
    // One pass is not enough, nor a run in which it was skipped.
    [['passed'], 'failed'],
    [['passed', 'skipped'], 'failed'],
    [['passed', 'passed', 'failed'], 'failed'],
    [[], 'failed'],
  ] as const)('and alone %j is %s', (alone, verdict) => {
    expect(verdictOf('failed', [...alone])).toBe(verdict);
  });

  it('is not excused by another test’s passes', () => {
    const again = [outcome('other', 'passed'), outcome('other', 'passed')];
    expect(judge([outcome('t', 'failed')], again, [])[0]?.verdict).toBe('failed');
  });
});

it('leaves what passed or was skipped as it is', () => {
  expect(verdictOf('passed', [])).toBe('passed');
  expect(verdictOf('skipped', [])).toBe('skipped');
});

it('counts a test in quarantine in neither way, but tells how it ended', () => {
  for (const status of ['passed', 'failed'] as const) {
    const [judged] = judge([outcome('t', status)], [], [entry('t')]);
    expect(judged).toMatchObject({ verdict: 'quarantined', status });
  }
  expect(verdictOf('failed', [], [entry('another')])).toBe('failed');
  expect(verdictOf('skipped', [], [entry('t')])).toBe('skipped');
});

it('runs again what failed, but for tests in quarantine', () => {
  const outcomes = [
    outcome('a', 'failed'),
    outcome('b', 'passed'),
    outcome('c', 'failed'),
    outcome('d', 'skipped'),
  ];
  expect(toRunAgain(outcomes, [entry('c')]).map(({ title }) => title)).toEqual(['a']);
});
