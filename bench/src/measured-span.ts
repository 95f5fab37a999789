/** Spans of time in which the processor time of programs is read, on the clock that they all share. */
import { coresBetween } from './cpu-time.ts';

/** The robot's, the bridge's and the link's clock: CLOCK_MONOTONIC. */
export function monotonicMs(): number {
  return Number(process.hrtime.bigint()) / 1e6;
}

export function wait(ms: number): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, ms));
}

export interface MeasuredSpan<Name extends string> {
  beginMs: number;
  endMs: number;
  elapsedMs: number;
  /** Mean number of cores that each program used; `null` without /proc. */
  cores: Record<Name, number | null>;
}

/** @param cpu reads the seconds of processor time of each program so far */
export async function measuredSpan<Name extends string>(
  cpu: () => Record<Name, number | null>,
  during: () => Promise<void>,
): Promise<MeasuredSpan<Name>> {
  const [beginMs, before] = [monotonicMs(), cpu()];
  await during();
  const [endMs, after] = [monotonicMs(), cpu()];
  const elapsedMs = endMs - beginMs;
  const names = Object.keys(before) as Name[];
  const cores = Object.fromEntries(
    names.map((name) => [name, coresBetween(before[name], after[name], elapsedMs)]),
  );
  return { beginMs, endMs, elapsedMs, cores: cores as Record<Name, number | null> };
}
