/** Reads the report of vitest's reporter `json`. Pure. */
import { relative } from 'node:path';
import * as z from 'zod';
import type { Outcome } from './outcome.ts';

const reportSchema = z.object({
  success: z.boolean(),
  testResults: z.array(
    z.object({
      name: z.string(),
      status: z.string(),
      message: z.string().default(''),
      startTime: z.number().default(0),
      endTime: z.number().default(0),
      assertionResults: z.array(
        z.object({
          ancestorTitles: z.array(z.string()),
          title: z.string(),
          status: z.string(),
          duration: z.number().nullish(),
          failureMessages: z.array(z.string()).nullish(),
          location: z.object({ line: z.number() }).nullish(),
        }),
      ),
    }),
  ),
});

export interface VitestReport {
  /** Whether vitest counts the run as passed; errors outside tests make it fail as well. */
  success: boolean;
  outcomes: Outcome[];
  /** How long each file took, ms. */
  fileMs: ReadonlyMap<string, number>;
}

/**
 * @param text the report @param root folder to which paths become relative
 * @throws {Error} if it is no such report
 */
export function readVitestReport(text: string, root: string): VitestReport {
  const { success, testResults } = reportSchema.parse(JSON.parse(text));
  const fileMs = new Map<string, number>();
  const outcomes = testResults.flatMap((result): Outcome[] => {
    const file = relative(root, result.name).replaceAll('\\', '/');
    fileMs.set(file, result.endTime - result.startTime);
    const tests = result.assertionResults.map(
      (test): Outcome => ({
        file,
        title: [...test.ancestorTitles, test.title].join(' > '),
        status: test.status === 'passed' ? 'passed' : test.status === 'failed' ? 'failed' : 'skipped',
        ms: test.duration ?? 0,
        reason: (test.failureMessages ?? []).join('\n'),
        line: test.location?.line ?? null,
        attachments: [],
      }),
    );
    // A file that does not load, or whose set-up fails, has no test that failed.
    const isExplained = tests.some(({ status }) => status === 'failed');
    if (result.status !== 'failed' || isExplained) return tests;
    return [
      ...tests,
      { file, title: '', status: 'failed', ms: 0, reason: result.message, line: null, attachments: [] },
    ];
  });
  return { success, outcomes, fileMs };
}
