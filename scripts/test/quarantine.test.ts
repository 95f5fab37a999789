import { describe, expect, it } from 'vitest';
import { readWorkspaceFile, workspaceFiles } from '../lib/workspace-files.ts';
import { daysLeft, MOST_QUARANTINED, quarantineOf, readQuarantine } from './quarantine.ts';

const ENTRY = {
  test: 'e2e/smoke/flat.smoke.ts > drives',
  since: '2026-11-28',
  until: '2026-12-12',
  cause: 'a page drawn in software reads its keys late',
  seen: '0.25 of 0.3 metres in 30 s',
  ends: 'grips of events survive a short pause of the page',
};
const yaml = (...entries: object[]) => JSON.stringify(entries);

describe('the quarantine', () => {
  it('may be empty', () => {
    expect(readQuarantine('# nothing\n')).toEqual([]);
    expect(readQuarantine('[]')).toEqual([]);
  });

  it('finds a test by its file and title', () => {
    const quarantine = readQuarantine(yaml(ENTRY));
    expect(quarantineOf({ file: 'e2e/smoke/flat.smoke.ts', title: 'drives' }, quarantine)).toEqual(ENTRY);
    expect(quarantineOf({ file: 'e2e/smoke/flat.smoke.ts', title: 'drives on' }, quarantine)).toBeUndefined();
    expect(quarantineOf({ file: 'e2e/smoke/other.smoke.ts', title: 'drives' }, quarantine)).toBeUndefined();
  });

  it.each([
    ['of the emergency stop', { test: 'e2e/pages/estop.page.ts > x' }],
    ['of grants', { test: 'apps/robot-node/src/grants.stack.test.ts > x' }],
    ['of strangers', { test: 'apps/robot-node/src/strangers.stack.test.ts > x' }],
    ['of packages/safety', { test: 'packages/safety/src/watchdog.test.ts > x' }],
    ['without a title', { test: 'e2e/smoke/flat.smoke.ts' }],
    ['that lasts longer than 14 days', { until: '2026-12-13' }],
    ['that ends before it begins', { until: '2026-11-27' }],
    ['without a cause', { cause: '' }],
    ['with a day that there is not', { until: '2026-11-31' }],
    ['with a field that nobody reads', { owner: 'me' }],
  ])('refuses an entry %s', (_, change) => {
    expect(() => readQuarantine(yaml({ ...ENTRY, ...change }))).toThrow();
  });

  it(`has at most ${MOST_QUARANTINED} entries`, () => {
    const entries = Array.from({ length: MOST_QUARANTINED + 1 }, (_, n) => ({
      ...ENTRY,
      test: `${ENTRY.test} ${n}`,
    }));
    expect(readQuarantine(yaml(...entries.slice(1)))).toHaveLength(MOST_QUARANTINED);
    expect(() => readQuarantine(yaml(...entries))).toThrow();
  });

  it('lasts through its last day', () => {
    const [entry] = readQuarantine(yaml(ENTRY));
    const at = (text: string) => daysLeft(entry!, Date.parse(text));
    expect(at('2026-11-28T00:00:00Z')).toBe(14);
    expect(at('2026-12-12T23:59:59Z')).toBe(0);
    expect(at('2026-12-13T00:00:01Z')).toBe(-1);
  });
});

it('tests/quarantine.yaml is well formed, and its tests exist', () => {
  for (const { test } of readQuarantine(readWorkspaceFile('tests/quarantine.yaml'))) {
    const [file = '', ...titles] = test.split(' > ');
    expect(workspaceFiles).toContain(file);
    expect(readWorkspaceFile(file), test).toContain(titles.at(-1));
  }
});
