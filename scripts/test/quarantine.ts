/** Reads `tests/quarantine.yaml`: tests that run and are listed, but do not decide. Pure. */
import { parse } from 'yaml';
import * as z from 'zod';
import { nameOf, type Outcome } from './outcome.ts';

/** More of them, and the tests that are left say too little. */
export const MOST_QUARANTINED = 5;
/** A quarantine is a promise to mend the test, or what it found, until then. */
const LONGEST_DAYS = 14;
/** What keeps people and robots safe is never left undecided. */
const NEVER = /^packages\/safety\/|estop|stop-delivery|robot-stops|\/stops\.|grant|access|stranger|hostile/;
const DAY_MS = 86_400_000;

const entrySchema = z
  .strictObject({
    /** The test as lists name it: `file > title`. */
    test: z.string().regex(/ > /, 'name it as the list of failures does: file > title'),
    since: z.iso.date(),
    until: z.iso.date(),
    /** What makes it fail without a fault of what it tests. */
    cause: z.string().min(10),
    /** What was seen. */
    seen: z.string().min(10),
    /** Who mends it, or which work ends it. */
    ends: z.string().min(10),
  })
  .refine(({ since, until }) => Date.parse(until) - Date.parse(since) <= LONGEST_DAYS * DAY_MS, {
    message: `a quarantine lasts at most ${LONGEST_DAYS} days`,
  })
  .refine(({ since, until }) => Date.parse(until) > Date.parse(since), {
    message: 'it ends before it begins',
  })
  .refine(({ test }) => !NEVER.test(test.split(' > ')[0] as string), {
    message: 'a test of STOP, grants, strangers or packages/safety may not be in quarantine',
  });

const quarantineSchema = z.array(entrySchema).max(MOST_QUARANTINED).nullable();

export type Quarantined = z.infer<typeof entrySchema>;

/** @throws {Error} that says which entry is wrong, and what about it */
export function readQuarantine(yaml: string): readonly Quarantined[] {
  return quarantineSchema.parse(parse(yaml)) ?? [];
}

export function quarantineOf(
  test: Pick<Outcome, 'file' | 'title'>,
  quarantine: readonly Quarantined[],
): Quarantined | undefined {
  const name = nameOf(test);
  return quarantine.find((entry) => entry.test === name);
}

/** Days that are left; negative once it has expired. @param nowMs since 1970 */
export function daysLeft({ until }: Quarantined, nowMs: number): number {
  return Math.ceil((Date.parse(until) + DAY_MS - nowMs) / DAY_MS) - 1;
}
