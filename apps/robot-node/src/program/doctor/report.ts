/** The doctor's report for people and for programs. */
import { withoutCredentials } from '@farpoint/service';
import type { Finding, Verdict } from './finding.ts';

const SIGNS: Record<Verdict, string> = { ok: '✓', warn: '!', fail: '✗' };
const NAME_WIDTH = 15;

/** The finding and its remedy in one line. */
export function findingLine({ check, verdict, detail, remedy }: Finding): string {
  const what = remedy === undefined ? detail : `${detail} → ${remedy}`;
  // A message from another program may contain newlines.
  return `${SIGNS[verdict]} ${check.padEnd(NAME_WIDTH)} ${withoutCredentials(what.replaceAll(/\s*\n\s*/g, '; '))}\n`;
}

export function summaryLine(findings: readonly Finding[]): string {
  const { fail, warn } = countVerdicts(findings);
  if (fail > 0) return `${fail} to fix${warn > 0 ? `, ${warn} worth a look` : ''}.\n`;
  return warn > 0 ? `Ready; ${warn} worth a look.\n` : 'Ready.\n';
}

/** `--json`: a single object. */
export function jsonReport(findings: readonly Finding[]): string {
  const { fail } = countVerdicts(findings);
  return `${withoutCredentials(JSON.stringify({ ready: fail === 0, findings }, null, 2))}\n`;
}

export function countVerdicts(findings: readonly Finding[]): Record<Verdict, number> {
  const counts = { ok: 0, warn: 0, fail: 0 };
  for (const { verdict } of findings) counts[verdict]++;
  return counts;
}
