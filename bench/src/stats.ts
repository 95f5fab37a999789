/** Summary statistics of benchmarks. */

export interface Distribution {
  p50: number;
  p95: number;
  p99: number;
  max: number;
}

/** The value that a share `q` of the ascending values do not exceed, interpolated; NaN without values. */
export function quantile(sorted: ArrayLike<number>, q: number): number {
  if (sorted.length === 0) return Number.NaN;
  const at = q * (sorted.length - 1);
  const below = Math.floor(at);
  const low = sorted[below] as number;
  const high = sorted[Math.min(below + 1, sorted.length - 1)] as number;
  return low + (high - low) * (at - below);
}

/** NaN (`null` in JSON) without values. */
export function distribution(values: Iterable<number>): Distribution {
  const sorted = Float64Array.from(values).sort();
  return {
    p50: quantile(sorted, 0.5),
    p95: quantile(sorted, 0.95),
    p99: quantile(sorted, 0.99),
    max: sorted.length === 0 ? Number.NaN : (sorted[sorted.length - 1] as number),
  };
}

/** The distribution rounded to `digits` decimals, for output. */
export function rounded(values: Distribution, digits = 3): Distribution {
  const round = (value: number) => Number(value.toFixed(digits));
  return { p50: round(values.p50), p95: round(values.p95), p99: round(values.p99), max: round(values.max) };
}

/** Times a synchronous function, in milliseconds: `warmup` calls that do not count, then `rounds` calls that do. */
export function timeCalls(call: (round: number) => void, rounds: number, warmup = 30): Float64Array {
  for (let round = 0; round < warmup; round++) call(round);
  const times = new Float64Array(rounds);
  for (let round = 0; round < rounds; round++) {
    const begin = performance.now();
    call(round);
    times[round] = performance.now() - begin;
  }
  return times;
}
