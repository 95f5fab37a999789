import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { MOST_REPORTS, SessionReports } from './session-reports.ts';
import { keepReports } from './stored-reports.ts';

const startOf = (id: string, nowMs = 0) => ({
  robot: { id, name: id },
  operator: { name: 'Ann', role: null },
  epochMs: 1_700_000_000_000,
  nowMs,
  maxLinearMps: 1,
});
const ids = (reports: SessionReports) => reports.all(0).map(({ robot, end }) => `${robot.id} ${end}`);

describe('the reports of a tab', () => {
  test('are of its sessions, the newest first, also of the one that lasts', () => {
    const reports = new SessionReports();
    expect(reports.all(0)).toEqual([]);
    reports.begin(startOf('a'));
    expect(ids(reports)).toEqual(['a null']);
    reports.begin(startOf('b'));
    reports.end('silent', 10);
    reports.end('left', 20);
    expect(ids(reports)).toEqual(['b silent', 'a new-session']);
    expect(reports.ended.value).toHaveLength(2);
    expect(reports.current).toBeNull();
  });

  test('are bounded', () => {
    const reports = new SessionReports();
    for (let i = 0; i <= MOST_REPORTS; i++) reports.begin(startOf(String(i)));
    reports.end('left', 0);
    expect(reports.ended.value).toHaveLength(MOST_REPORTS);
    expect(ids(reports).at(-1)).toBe('1 new-session');
    reports.begin(startOf('last'));
    expect(JSON.parse(reports.text('page-left', 0))).toHaveLength(MOST_REPORTS);
  });

  test('are kept while the page is loaded anew, and the session that lasted is over', () => {
    const before = new SessionReports();
    before.begin(startOf('a'));
    before.begin(startOf('b', 1000));
    const values = new Map<string, string>();
    const storage = () => ({
      getItem: (key: string) => values.get(key) ?? null,
      setItem: (key: string, value: string) => void values.set(key, value),
    });
    const page = new EventTarget();
    keepReports(before, page, storage, () => 4000);
    page.dispatchEvent(new Event('pagehide'));
    const after = new SessionReports();
    keepReports(after, new EventTarget(), storage, () => 0);
    expect(ids(after)).toEqual(['b page-left', 'a new-session']);
    expect(after.ended.value[0]).toMatchObject({ durationS: 3, endedMs: 1_700_000_003_000 });
  });

  test('are none where the tab has anything else, or may keep nothing', () => {
    const anything = fc.oneof(fc.string(), fc.json(), fc.constant(null));
    fc.assert(
      fc.property(anything, (text) => {
        const reports = new SessionReports();
        reports.restore(text);
        expect(reports.all(0)).toEqual([]);
      }),
    );
    const page = new EventTarget();
    const reports = new SessionReports();
    keepReports(
      reports,
      page,
      () => {
        throw new Error('no storage');
      },
      () => 0,
    );
    page.dispatchEvent(new Event('pagehide'));
    expect(reports.all(0)).toEqual([]);
  });
});
