import { type KnownDefect, knownDefects } from '../known-defects.ts';
import { type Addresses, findGone, findUnreachable, UnreachableError } from '../reach.ts';

export const LEVELS = ['reference', 'strict'] as const;
/** `reference`: what the released programs do, tolerating known defects; `strict`: what they should have done. */
export type Level = (typeof LEVELS)[number];

/** One requirement for an implementation; it throws if the implementation fails it, or cannot be reached. */
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

export interface SuiteOptions {
  onResult?: ((result: CaseResult) => void) | undefined;
  /** Where the implementation must be reached: before the first case, and after each. */
  addresses?: Addresses | undefined;
}

/**
 * Runs all cases one after the other, whatever the result of each. If the implementation cannot be reached, or goes away,
 * the remaining cases are not tried: see `whyUnfinished`.
 */
export async function runSuite<Target>(
  cases: readonly ConformanceCase<Target>[],
  target: Target,
  level: Level,
  { onResult, addresses = {} }: SuiteOptions = {},
): Promise<CaseResult[]> {
  const results: CaseResult[] = [];
  let unreachable = await findUnreachable(addresses);
  for (const tried of cases) {
    let result: CaseResult = {
      name: tried.name,
      outcome: 'not-tried',
      fault: unreachable?.message ?? null,
      defect: null,
    };
    if (unreachable === null) {
      try {
        result = await runCase(tried, target, level);
        unreachable = await findGone(addresses, tried.name);
        // A known defect of the released programs ends none of them, except in cases that are not tried for that reason.
        if (unreachable !== null && result.outcome === 'known-defect')
          result = { ...result, outcome: 'failed', defect: null };
      } catch (error) {
        if (!(error instanceof UnreachableError)) throw error;
        unreachable = error;
        result.fault = error.message;
      }
    }
    results.push(result);
    onResult?.(result);
  }
  return results;
}

/** Why cases were not tried, if not for a known defect. `null`: the suite is complete. */
export function whyUnfinished(results: readonly CaseResult[]): string | null {
  return results.find(isLeftOver)?.fault ?? null;
}

/** The case was not tried because the implementation could not be reached. */
export function isLeftOver({ outcome, defect }: CaseResult): boolean {
  return outcome === 'not-tried' && defect === null;
}

/** @throws {UnreachableError} */
async function runCase<Target>(
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
    if (error instanceof UnreachableError) throw error;
    const fault = error instanceof Error ? error.message : String(error);
    return { name, outcome: allowed === null ? 'failed' : 'known-defect', fault, defect: allowed };
  }
}

/** @throws {Error} with `what` if it does not hold */
export function must(holds: boolean, what: string): asserts holds {
  if (!holds) throw new Error(what);
}
