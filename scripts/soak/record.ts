/** What a soak has shown so far, as it is kept for one that goes on from there. Pure. */
import * as z from 'zod';
import type { PartResult } from './results.ts';

export interface SoakRecord {
  /** What was tested; `null`: a tree with uncommitted changes, of which nobody can say later what it was. */
  commit: string | null;
  seed: number;
  results: PartResult[];
}

const schema: z.ZodType<SoakRecord> = z.object({
  commit: z.string().nullable(),
  seed: z.int().positive(),
  results: z.array(
    z.object({
      name: z.string(),
      what: z.string(),
      outcome: z.enum(['passed', 'failed', 'left out']),
      ms: z.number().nonnegative(),
      words: z.string(),
      lastLines: z.array(z.string()),
    }),
  ),
});

/**
 * What of an earlier soak still counts: parts of the same commit that have passed.
 *
 * @param text of the record; `null` if there is none
 * @param commit that is to be tested now
 * @returns or why nothing does
 */
export function readRecord(text: string | null, commit: string | null): SoakRecord | string {
  if (text === null) return 'no soak has run here';
  if (commit === null) return 'the tree has uncommitted changes';
  let record: SoakRecord;
  try {
    record = schema.parse(JSON.parse(text));
  } catch {
    return 'what the last soak has left cannot be read';
  }
  if (record.commit !== commit)
    return `the last soak was of ${record.commit?.slice(0, 8) ?? 'a tree with uncommitted changes'}`;
  return { ...record, results: record.results.filter(({ outcome }) => outcome === 'passed') };
}
