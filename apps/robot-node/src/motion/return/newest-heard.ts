export interface HeardOperator {
  /** When it was last heard, on any channel, or by RTCP or a connectivity check: robot's clock, ms. */
  readonly heardMs: number;
}

/** When any operator was last heard, robot's clock, ms; −∞ if there is none. */
export function newestHeardMs(operators: Iterable<HeardOperator | null | undefined>): number {
  let newest = Number.NEGATIVE_INFINITY;
  for (const operator of operators) newest = Math.max(newest, operator?.heardMs ?? newest);
  return newest;
}
