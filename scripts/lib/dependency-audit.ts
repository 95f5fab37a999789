/** Judges what `pnpm audit` says about the production dependencies. */
import * as z from 'zod';

const reportSchema = z.object({
  advisories: z.record(
    z.string(),
    z.object({
      github_advisory_id: z.string(),
      module_name: z.string(),
      severity: z.string(),
      title: z.string(),
      patched_versions: z.string().optional(),
      url: z.string(),
      findings: z.array(z.object({ version: z.string(), paths: z.array(z.string()) })),
    }),
  ),
});

export type AuditReport = z.output<typeof reportSchema>;

const acceptedSchema = z.strictObject({
  comment: z.string(),
  advisories: z.array(
    z.strictObject({
      /** Of the GitHub Advisory Database. */
      id: z.string().regex(/^GHSA(-[0-9a-z]{4}){3}$/),
      package: z.string().min(1),
      /** Why it does not concern this project. */
      reason: z.string().min(20),
      /** When it must be looked at again. */
      until: z.iso.date(),
    }),
  ),
});

export type AcceptedAdvisory = z.output<typeof acceptedSchema>['advisories'][number];

/** What the audit found, or why it could not be made. */
export type AuditOutcome =
  | { readonly made: true; readonly faults: readonly string[] }
  | { readonly made: false; readonly reason: string };

/** @throws {Error} if the file is not as it must be */
export function readAccepted(text: string): AcceptedAdvisory[] {
  return acceptedSchema.parse(JSON.parse(text)).advisories;
}

/**
 * @param output of `pnpm audit --json`: its standard output, its standard error, and whether it ended in time
 * @param today as YYYY-MM-DD
 */
export function judgeAudit(
  { stdout, stderr, inTime }: { stdout: string; stderr: string; inTime: boolean },
  accepted: readonly AcceptedAdvisory[],
  today: string,
): AuditOutcome {
  const report = readReport(stdout);
  if (report !== null) return { made: true, faults: faultsOf(report, accepted, today) };
  const words = stderr.replaceAll(/[\s│×]+/g, ' ').trim();
  const reason = inTime ? words.slice(0, 200) || 'pnpm audit says nothing' : 'no answer in time';
  return { made: false, reason };
}

function readReport(stdout: string): AuditReport | null {
  try {
    return reportSchema.parse(JSON.parse(stdout));
  } catch {
    return null;
  }
}

function faultsOf(
  { advisories }: AuditReport,
  accepted: readonly AcceptedAdvisory[],
  today: string,
): string[] {
  const found = Object.values(advisories);
  const faults: string[] = [];
  for (const advisory of found) {
    const { github_advisory_id: id, module_name: name, severity, title, url, findings } = advisory;
    const known = accepted.find((each) => each.id === id && each.package === name);
    if (known !== undefined && known.until >= today) continue;
    const versions = [...new Set(findings.map(({ version }) => version))].join(', ');
    const [path = ''] = findings.flatMap(({ paths }) => paths);
    const mended = advisory.patched_versions === undefined ? '' : `, mended in ${advisory.patched_versions}`;
    const again = known === undefined ? '' : `; it was accepted until ${known.until}`;
    faults.push(`${severity}: ${name} ${versions} (${path}): ${title}${mended}${again}: ${url}`);
  }
  for (const { id, package: name } of accepted) {
    const there = found.some((each) => each.github_advisory_id === id && each.module_name === name);
    if (!there) faults.push(`${id} (${name}) is accepted and no longer reported: remove it from the list`);
  }
  return faults;
}
