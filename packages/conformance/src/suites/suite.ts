/** One thing that an implementation must do; it throws where it does not. */
export interface ConformanceCase<Target> {
  name: string;
  run(target: Target): Promise<void>;
}

export interface CaseResult {
  name: string;
  /** What went wrong; `null` where all is well. */
  fault: string | null;
}

/** Runs all of them, one after another, whatever becomes of each. */
export async function runSuite<Target>(
  cases: readonly ConformanceCase<Target>[],
  target: Target,
  onResult: (result: CaseResult) => void = () => undefined,
): Promise<CaseResult[]> {
  const results: CaseResult[] = [];
  for (const { name, run } of cases) {
    let fault: string | null = null;
    try {
      await run(target);
    } catch (error) {
      fault = error instanceof Error ? error.message : String(error);
    }
    results.push({ name, fault });
    onResult({ name, fault });
  }
  return results;
}

/** @throws {Error} with `what` where it does not hold */
export function must(holds: boolean, what: string): asserts holds {
  if (!holds) throw new Error(what);
}
