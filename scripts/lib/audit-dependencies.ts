/** Runs `pnpm audit` over the production dependencies. */
import { execFile } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { type AuditOutcome, judgeAudit, readAccepted } from './dependency-audit.ts';
import { root } from './run.ts';

const TIME_LIMIT_MS = 30_000;

/** @throws {Error} if the list of accepted advisories is not as it must be */
export async function auditDependencies(): Promise<AuditOutcome> {
  const accepted = readAccepted(readFileSync(join(root, 'scripts', 'accepted-advisories.json'), 'utf8'));
  const output = await new Promise<Parameters<typeof judgeAudit>[0]>((resolve) => {
    // Its exit status says only that there is something to read.
    execFile(
      'pnpm',
      ['audit', '--prod', '--json'],
      { cwd: root, timeout: TIME_LIMIT_MS, killSignal: 'SIGKILL', maxBuffer: 1 << 26 },
      (error, stdout, stderr) => {
        const missing = error?.code === 'ENOENT' ? error.message : '';
        resolve({ stdout, stderr: stderr || missing, inTime: error?.killed !== true });
      },
    );
  });
  return judgeAudit(output, accepted, new Date().toISOString().slice(0, 10));
}
