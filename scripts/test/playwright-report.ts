/** Reads the report of Playwright's reporter `json`. Pure. */
import { stripVTControlCharacters } from 'node:util';
import * as z from 'zod';
import type { Outcome } from './outcome.ts';

const resultSchema = z.object({
  status: z.string().optional(),
  duration: z.number(),
  errors: z.array(z.object({ message: z.string().default('') })).default([]),
  attachments: z.array(z.object({ name: z.string(), path: z.string().optional() })).default([]),
});

const specSchema = z.object({
  title: z.string(),
  file: z.string(),
  line: z.number(),
  tests: z.array(z.object({ status: z.string(), results: z.array(resultSchema) })),
});

interface Suite {
  title: string;
  specs: z.infer<typeof specSchema>[];
  suites?: Suite[] | undefined;
}

const suiteSchema: z.ZodType<Suite> = z.lazy(() =>
  z.object({ title: z.string(), specs: z.array(specSchema), suites: z.array(suiteSchema).optional() }),
);

const reportSchema = z.object({
  suites: z.array(suiteSchema),
  errors: z.array(z.object({ message: z.string().default('') })).default([]),
});

export interface PlaywrightReport {
  /** One for each time that a test ran: several with `--repeat-each`. */
  outcomes: Outcome[];
  /** What went wrong outside tests. */
  errors: string[];
}

/**
 * @param text the report @param folder the tests' folder, relative to the repository's root
 * @throws {Error} if it is no such report
 */
export function readPlaywrightReport(text: string, folder: string): PlaywrightReport {
  const { suites, errors } = reportSchema.parse(JSON.parse(text));
  const outcomes: Outcome[] = [];
  const read = (suite: Suite, around: readonly string[]): void => {
    for (const spec of suite.specs)
      for (const { status, results } of spec.tests) {
        const last = results.at(-1);
        outcomes.push({
          file: `${folder}/${spec.file}`,
          title: [...around, spec.title].join(' > '),
          status: status === 'skipped' ? 'skipped' : status === 'expected' ? 'passed' : 'failed',
          ms: results.reduce((sum, { duration }) => sum + duration, 0),
          reason: stripVTControlCharacters(last?.errors.map(({ message }) => message).join('\n') ?? ''),
          line: spec.line,
          attachments: last?.attachments.flatMap(({ path }) => path ?? []) ?? [],
        });
      }
    for (const inner of suite.suites ?? []) read(inner, [...around, inner.title]);
  };
  // The outermost suites are files.
  for (const suite of suites) read(suite, []);
  return { outcomes, errors: errors.map(({ message }) => stripVTControlCharacters(message)) };
}
