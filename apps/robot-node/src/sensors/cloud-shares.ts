import { allocate } from '@farpoint/congestion';
import { BitRate } from '@farpoint/timing';

/** How a sensor's clouds stand against those of others. */
export interface CloudClaim {
  /** Lower goes first: it gets what it can use before the next gets more than its least. */
  priority: number;
  /** Share among sensors of the same priority. */
  weight: number;
  /** What its clouds could use at most on the wire, bit/s; infinite while that is not known. */
  usefulBitsPerSecond: number;
}

/** Clouds at less than this show nothing: so much everybody gets first, as far as it reaches. */
const LEAST_BITS_PER_SECOND = BitRate.fromMbps(0.5);

/**
 * The sensor whose frames carry the padding of a path's probes: the most important one that sends anything.
 *
 * @param claims by sensor number
 * @param wanted sensor numbers
 * @returns its number, `null` where none of those that are wanted sends
 */
export function probingSensor(claims: readonly CloudClaim[], wanted: ReadonlySet<number>): number | null {
  let best: { number: number; priority: number } | null = null;
  for (const [number, { priority, usefulBitsPerSecond }] of claims.entries()) {
    if (!wanted.has(number) || usefulBitsPerSecond <= 0) continue;
    if (best === null || priority < best.priority) best = { number, priority };
  }
  return best?.number ?? null;
}

/**
 * Shares what a path has for clouds among the sensors that its operator wants.
 *
 * @param claims by sensor number
 * @param wanted sensor numbers; those without a claim get nothing
 * @returns of `sensor`, bit/s on the wire
 */
export function cloudShare(
  sensor: number,
  totalBitsPerSecond: number,
  claims: readonly CloudClaim[],
  wanted: ReadonlySet<number>,
): number {
  if (!wanted.has(sensor) || claims[sensor] === undefined) return 0;
  const rivals = claims
    .map((claim, number) => ({ ...claim, number }))
    .filter(({ number }) => wanted.has(number));
  // Alone it is not held to what it is known to use: it may have learnt to use more.
  if (rivals.length === 1) return totalBitsPerSecond;
  const rates = allocate(
    totalBitsPerSecond,
    rivals.map(({ number, priority, weight, usefulBitsPerSecond }) => ({
      ...{ name: String(number), priority, weight },
      leastBitsPerSecond: Math.min(LEAST_BITS_PER_SECOND, usefulBitsPerSecond),
      mostBitsPerSecond: usefulBitsPerSecond,
    })),
  );
  return rates.get(String(sensor)) ?? 0;
}
