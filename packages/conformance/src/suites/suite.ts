import { type KnownDefect, knownDefects } from '../known-defects.ts';

export const LEVELS = ['reference', 'strict'] as const;
/** `reference`: what the released programs do, tolerating known defects; `strict`: what they should have done. */
export type Level = (typeof LEVELS)[number];

/** One requirement for an implementation; it throws if the implementation fails it. */
export interface ConformanceCase<Target> {
  name: string;
  run(target: Target, level: Level): Promise<void>;
  /** Why the released program fails this case. */
  defect?: KnownDefect | undefined;
  /** With that defect, the case ends the program: it is run at level `strict` only. */
  deadly?: boolean | undefined;
}

export type Outcome = 'passed' | 'failed' | 'known-defect' | 'not-tried';

export interface CaseResult {
  name: string;
  outcome: Outcome;
  /** What went wrong, or why it was not run; `null` if it passed. */
  fault: string | null;
  /** The known defect because of which the case did not pass. */
  defect: KnownDefect | null;
}

/** Runs all cases one after the other, whatever the result of each. */
export async function runSuite<Target>(
  cases: readonly ConformanceCase<Target>[],
  target: Target,
  level: Level,
  onResult: (result: CaseResult) => void = () => undefined,
): Promise<CaseResult[]> {
  const results: CaseResult[] = [];
  for (const tried of cases) {
    const result = await runCase(tried, target, level);
    results.push(result);
    onResult(result);
  }
  return results;
}

export async function runCase<Target>(
  { name, run, defect, deadly }: ConformanceCase<Target>,
  target: Target,
  level: Level,
): Promise<CaseResult> {
  const allowed = level === 'reference' ? (defect ?? null) : null;
  if (allowed !== null && deadly)
    return { name, outcome: 'not-tried', fault: knownDefects[allowed], defect: allowed };
  try {
    await run(target, level);
    return { name, outcome: 'passed', fault: null, defect: null };
  } catch (error) {
    const fault = error instanceof Error ? error.message : String(error);
    return { name, outcome: allowed === null ? 'failed' : 'known-defect', fault, defect: allowed };
  }
}

/** @throws {Error} with `what` if it does not hold */
export function must(holds: boolean, what: string): asserts holds {
  if (!holds) throw new Error(what);
}
