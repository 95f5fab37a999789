import { describe, expect, it } from 'vitest';
import { readPlaywrightReport } from './playwright-report.ts';
import { readVitestReport } from './vitest-report.ts';

describe('vitest’s report', () => {
  const report = (testResults: object[], success = false) =>
    JSON.stringify({ success, numTotalTests: 2, testResults });
  const test_ = (title: string, status: string, more: object = {}) => ({
    ...{ ancestorTitles: ['a robot', 'that drives'], fullName: '', title, status, duration: 12.5, ...more },
  });

  it('gives each test, with what its suites are called', () => {
    const { outcomes, success, fileMs } = readVitestReport(
      report([
        {
          ...{
            name: '/r/packages/a/a.test.ts',
            status: 'failed',
            message: '',
            startTime: 1000,
            endTime: 3500,
          },
          assertionResults: [
            test_('stops', 'passed'),
            test_('brakes', 'failed', { failureMessages: ['expected 1', 'to be 2'], location: { line: 7 } }),
            test_('waits', 'pending'),
            test_('rests', 'skipped'),
          ],
        },
      ]),
      '/r',
    );
    expect(success).toBe(false);
    expect(fileMs.get('packages/a/a.test.ts')).toBe(2500);
    expect(outcomes.map(({ title, status }) => [title, status])).toEqual([
      ['a robot > that drives > stops', 'passed'],
      ['a robot > that drives > brakes', 'failed'],
      ['a robot > that drives > waits', 'skipped'],
      ['a robot > that drives > rests', 'skipped'],
    ]);
    expect(outcomes[1]).toMatchObject({
      ...{ file: 'packages/a/a.test.ts', line: 7, ms: 12.5, reason: 'expected 1\nto be 2' },
    });
  });

  it('counts a file that does not load as a failure of its own', () => {
    const broken = {
      name: '/r/b.test.ts',
      status: 'failed',
      message: 'no such module',
      assertionResults: [],
    };
    const { outcomes } = readVitestReport(report([broken]), '/r');
    expect(outcomes).toEqual([
      expect.objectContaining({ file: 'b.test.ts', title: '', status: 'failed', reason: 'no such module' }),
    ]);
  });

  it('counts a file whose set-up fails, although its tests count as skipped', () => {
    const broken = {
      ...{ name: '/r/b.test.ts', status: 'failed', message: 'no robot' },
      assertionResults: [test_('stops', 'skipped')],
    };
    expect(readVitestReport(report([broken]), '/r').outcomes.map(({ status }) => status)).toEqual([
      'skipped',
      'failed',
    ]);
  });

  it.each(['', '{}', '{"success":true}', '{"success":true,"testResults":[{}]}'])(
    'is refused if it is %j',
    (text) => {
      expect(() => readVitestReport(text, '/r')).toThrow();
    },
  );
});

describe('Playwright’s report', () => {
  const spec = (title: string, status: string, results: object[]) => ({
    ...{ title, file: 'flat.smoke.ts', line: 7, ok: status === 'expected' },
    tests: [{ projectName: 'chromium', status, results }],
  });
  const result = (more: object = {}) => ({ status: 'passed', duration: 1500, ...more });
  const report = (specs: object[], suites: object[] = [], errors: object[] = []) =>
    JSON.stringify({ suites: [{ title: 'flat.smoke.ts', specs, suites }], errors });

  it('gives each test, how long it took and what it left behind', () => {
    const failure = result({
      ...{ status: 'failed', errors: [{ message: '\u001b[31mexpected 0.3\u001b[39m' }] },
      attachments: [{ name: 'trace', path: '/t/trace.zip' }, { name: 'stdout' }],
    });
    const inner = { title: 'a phone', specs: [spec('stops', 'skipped', [])] };
    const { outcomes, errors } = readPlaywrightReport(
      report([spec('drives', 'unexpected', [failure]), spec('waits', 'expected', [result()])], [inner]),
      'e2e/smoke',
    );
    expect(errors).toEqual([]);
    expect(outcomes).toEqual([
      {
        ...{ file: 'e2e/smoke/flat.smoke.ts', title: 'drives', status: 'failed', ms: 1500, line: 7 },
        ...{ reason: 'expected 0.3', attachments: ['/t/trace.zip'] },
      },
      expect.objectContaining({ title: 'waits', status: 'passed' }),
      expect.objectContaining({ title: 'a phone > stops', status: 'skipped' }),
    ]);
  });

  it('counts what the runner itself calls flaky as failed, and knows a test that timed out', () => {
    const { outcomes } = readPlaywrightReport(
      report([
        spec('a', 'flaky', [result(), result()]),
        spec('b', 'unexpected', [result({ status: 'timedOut' })]),
      ]),
      'e2e/smoke',
    );
    expect(outcomes.map(({ status }) => status)).toEqual(['failed', 'failed']);
  });

  it('gives errors outside tests', () => {
    expect(readPlaywrightReport(report([], [], [{ message: 'no browser' }]), '').errors).toEqual([
      'no browser',
    ]);
  });

  it.each(['', '{}', '{"suites":[{}]}'])('is refused if it is %j', (text) => {
    expect(() => readPlaywrightReport(text, '')).toThrow();
  });
});
