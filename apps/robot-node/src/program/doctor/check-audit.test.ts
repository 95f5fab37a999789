import { appendFileSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { AuditLog } from '@farpoint/audit';
import { useFolder } from '@farpoint/service/testing/folder';
import { expect, it } from 'vitest';
import { checkAudit } from './check-audit.ts';

const folder = useFolder();

it('says whether the audit log can be written, and is as it was written', async () => {
  const path = join(folder, 'audit.jsonl');
  expect(checkAudit(undefined)).toEqual([]);
  expect(checkAudit(join(folder, 'no', 'audit'))).toMatchObject([{ verdict: 'fail' }]);
  mkdirSync(join(folder, 'folder'));
  writeFileSync(join(folder, 'folder', 'x'), '');
  expect(checkAudit(path)).toMatchObject([{ verdict: 'ok', detail: `${path} will be created` }]);
  const log = await AuditLog.open({
    ...{ path, maxBytes: 1e6, nowMs: () => 0, clockMs: () => 0 },
    ...{ onFault: () => undefined, onDamage: () => undefined },
  });
  for (const kind of ['started', 'stopped'] as const) log.record({ kind });
  await log.close();
  expect(checkAudit(path)).toMatchObject([{ verdict: 'ok', detail: `${path}: 2 entries, as written` }]);
  const text = readFileSync(path, 'utf8');
  appendFileSync(path, '{"hash');
  expect(checkAudit(path)).toMatchObject([{ verdict: 'ok', detail: expect.stringContaining('torn') }]);
  writeFileSync(path, text.replace('started', 'changed'));
  expect(checkAudit(path)).toMatchObject([
    {
      verdict: 'warn',
      detail: `${path} is not as it was written: line 1: what is before entry 1 is not what was written`,
    },
  ]);
});
