import { describe, expect, it } from 'vitest';
import { type StepSummary, summaryOf } from './summary.ts';
import type { Judged } from './verdict.ts';

const judged = (title: string, verdict: Judged['verdict'], more: Partial<Judged> = {}): Judged => ({
  ...{ file: 'e2e/smoke/a.smoke.ts', title, status: verdict === 'passed' ? 'passed' : 'failed', verdict },
  ...{ ms: 2000, reason: '', line: 7, attachments: [], alone: [] },
  ...more,
});
const step = (name: string, more: Partial<StepSummary> = {}): StepSummary => ({
  ...{ name, ms: 61_000, ok: true, judged: [], failure: null, notTested: [], proven: [], ...more },
});
const NOW = Date.parse('2026-11-28T12:00:00Z');
const summary = (steps: StepSummary[], quarantine: Parameters<typeof summaryOf>[3] = []) =>
  summaryOf(steps, 125_000, (name, { file, line }) => `repeat ${name} ${file}:${line}`, quarantine, NOW);

describe('the summary', () => {
  it('says of each step whether it passed, and how long all took', () => {
    expect(summary([step('pure'), step('smoke', { ok: false })])[0]).toBe(
      '2 min 5 s   pure ✓ 61   smoke ✗ 61',
    );
    const many = summary(Array.from({ length: 20 }, (_, n) => step(`step-${n}`)));
    expect(many.join(' ')).toContain('step-19 ✓ 61');
  });

  it('says of a failure what was expected, how it ended alone, what repeats it and what it left', () => {
    const alone = [judged('drives', 'failed', { attachments: ['/t/trace.zip'] }), judged('drives', 'passed')];
    const failure = judged('drives', 'failed', { reason: 'expected 0.3\n\nto be 0.5\na\nb', alone });
    expect(summary([step('smoke', { ok: false, judged: [failure] })]).slice(1, 7)).toEqual([
      'FAILED  smoke  e2e/smoke/a.smoke.ts > drives (line 7)',
      '        expected 0.3',
      '        to be 0.5',
      '        a',
      '        alone: failed, passed; again: repeat smoke e2e/smoke/a.smoke.ts:7',
      '        left behind: /t/trace.zip',
    ]);
  });

  it('names what was flaky, in quarantine, not tested, and passed before', () => {
    const entry = {
      ...{ test: 'e2e/smoke/a.smoke.ts > keys', since: '2026-11-28', until: '2026-12-05' },
      ...{ cause: '', seen: '', ends: '' },
    };
    const tests = [
      judged('turns', 'flaky', { alone: [judged('turns', 'passed'), judged('turns', 'passed')] }),
      judged('keys', 'quarantined'),
    ];
    const steps = [
      step('smoke', { judged: tests, notTested: ['relays: no TURN server'], proven: ['rust (2026-11-27)'] }),
    ];
    const text = summary(steps, [entry]).join('\n');
    expect(text).toContain('smoke ✓ 61 (1 flaky, in part)');
    expect(text).toContain('flaky (passed 2/2 alone)  smoke  e2e/smoke/a.smoke.ts > turns');
    expect(text).toContain('quarantined (7 days left)  smoke  e2e/smoke/a.smoke.ts > keys: failed');
    expect(text).toContain('not tested here  relays: no TURN server');
    expect(text).toContain('passed before, with the same inputs  rust (2026-11-27)');
    expect(summary(steps, [{ ...entry, until: '2026-11-26' }]).join('\n')).toContain('EXPIRED 2 days ago');
  });

  it('says that too many flaky tests are a fault', () => {
    const flaky = ['a', 'b', 'c', 'd'].map((title) => judged(title, 'flaky'));
    expect(summary([step('smoke', { judged: flaky.slice(1) })]).join('\n')).not.toContain('FAILED');
    expect(summary([step('smoke', { judged: flaky })]).join('\n')).toContain('FAILED  4 flaky tests');
  });

  it('has at most 40 lines, and none of them is long', () => {
    const failures = Array.from({ length: 60 }, (_, n) =>
      judged(`${'long '.repeat(60)}${n}`, 'failed', { reason: 'x'.repeat(500) }),
    );
    const lines = summary([step('smoke', { ok: false, judged: failures, failure: 'and\nthat\ntoo' })]);
    expect(lines.length).toBeLessThanOrEqual(40);
    expect(Math.max(...lines.map(({ length }) => length))).toBeLessThanOrEqual(150);
    expect(lines.join('\n')).toContain('FAILED  and 52 more');
  });
});
