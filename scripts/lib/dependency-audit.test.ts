import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import { type AcceptedAdvisory, judgeAudit, readAccepted } from './dependency-audit.ts';

const TODAY = '2026-06-01';
/** As pnpm 12 writes it. */
const report = {
  advisories: {
    '1234': {
      findings: [
        {
          version: '8.23.0',
          paths: ['apps__robot-node>ws', 'bench>ws'],
          dev: false,
          optional: false,
          bundled: false,
        },
      ],
      ...{ id: 1234, title: 'Denial of service', module_name: 'ws', vulnerable_versions: '<9.0.0' },
      ...{ patched_versions: '>=9.0.0', severity: 'high', cwe: 'CWE-400' },
      github_advisory_id: 'GHSA-aaaa-bbbb-cccc',
      url: 'https://github.com/advisories/GHSA-aaaa-bbbb-cccc',
    },
  },
  metadata: { vulnerabilities: { info: 0, low: 0, moderate: 0, high: 1, critical: 0 } },
};
const accepted: AcceptedAdvisory = {
  ...{ id: 'GHSA-aaaa-bbbb-cccc', package: 'ws', until: '2026-06-01' },
  reason: 'only for a server that accepts compression, which none does',
};
const judge = (value: unknown, ...known: AcceptedAdvisory[]) =>
  judgeAudit({ stdout: JSON.stringify(value), stderr: '', inTime: true }, known, TODAY);

describe('the dependency audit', () => {
  it('fails for an advisory, and says what to do about it', () => {
    expect(judge(report)).toEqual({
      made: true,
      faults: [
        'high: ws 8.23.0 (apps__robot-node>ws): Denial of service, mended in >=9.0.0: https://github.com/advisories/GHSA-aaaa-bbbb-cccc',
      ],
    });
  });

  it('passes without advisories, and with one that is accepted until a later day', () => {
    expect(judge({ advisories: {} })).toEqual({ made: true, faults: [] });
    expect(judge(report, accepted)).toEqual({ made: true, faults: [] });
  });

  it('fails again when the day has passed, and when an accepted advisory is no longer reported', () => {
    expect(judge(report, { ...accepted, until: '2026-05-31' })).toMatchObject({
      faults: [expect.stringContaining('it was accepted until 2026-05-31')],
    });
    expect(judge(report, { ...accepted, package: 'other' })).toMatchObject({ faults: { length: 2 } });
    expect(judge({ advisories: {} }, accepted)).toMatchObject({
      faults: [expect.stringContaining('no longer reported')],
    });
  });

  it('says why it could not be made', () => {
    const stderr =
      'Error: ERR_PNPM_AUDIT_BAD_RESPONSE\n\n  × The audit endpoint (at https://x/\n  │ bulk) responded with 405:\n';
    expect(judgeAudit({ stdout: '', stderr, inTime: true }, [], TODAY)).toEqual({
      made: false,
      reason:
        'Error: ERR_PNPM_AUDIT_BAD_RESPONSE The audit endpoint (at https://x/ bulk) responded with 405:',
    });
    expect(judgeAudit({ stdout: '', stderr: '', inTime: false }, [], TODAY)).toMatchObject({
      reason: 'no answer in time',
    });
    expect(judge({ advisories: [] })).toMatchObject({ made: false });
  });

  it('has a list of accepted advisories with reasons', () => {
    const text = readFileSync(join(import.meta.dirname, '..', 'accepted-advisories.json'), 'utf8');
    expect(readAccepted(text)).toEqual(expect.any(Array));
    expect(() => readAccepted('{"comment": "", "advisories": [{"id": "GHSA-aaaa-bbbb-cccc"}]}')).toThrow();
  });
});
