/** The doctor's findings, and the time limits of its checks. */

export type Verdict = 'ok' | 'warn' | 'fail';

export interface Finding {
  /** What was checked, e.g. `signaling`. */
  check: string;
  verdict: Verdict;
  /** The finding: one sentence, with figures and their units. */
  detail: string;
  /** What to do about it, for warnings and failures. */
  remedy?: string;
}

/** A finding without the name of its check. */
export type Result = Omit<Finding, 'check'>;

export const ok = (detail: string): Result => ({ verdict: 'ok', detail });
export const warn = (detail: string, remedy: string): Result => ({ verdict: 'warn', detail, remedy });
export const fail = (detail: string, remedy: string): Result => ({ verdict: 'fail', detail, remedy });

export interface Check {
  name: string;
  /** Time limit, ms. A check that takes longer has failed. */
  withinMs: number;
  run(): Promise<readonly Result[]> | readonly Result[];
}

/** Runs a check. Never throws, and never exceeds the check's time limit. */
export async function runCheck({ name, withinMs, run }: Check): Promise<Finding[]> {
  let timer: NodeJS.Timeout | undefined;
  const late = new Promise<readonly Result[]>((resolve) => {
    timer = setTimeout(
      () =>
        resolve([
          fail(
            `no answer within ${withinMs / 1000} s`,
            'find out what hangs; the rest was checked all the same',
          ),
        ]),
      withinMs,
    );
  });
  const failed = (error: unknown) => [
    fail(
      `the check itself failed: ${error instanceof Error ? error.message : String(error)}`,
      'report this with the output of --json',
    ),
  ];
  const results = await Promise.race([Promise.resolve().then(run).catch(failed), late]);
  clearTimeout(timer);
  return results.map((result) => ({ check: name, ...result }));
}
