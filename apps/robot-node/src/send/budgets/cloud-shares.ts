import { allocate } from '@farpoint/congestion';
import { LEAST_CLOUD_BITS_PER_SECOND } from '../../sense/encode/capture-budget.ts';

/** A sensor's claim to a share of the link. */
export interface CloudClaim {
  /** A lower number goes first: it gets all that it can use before the next gets more than its minimum. */
  priority: number;
  /** Share among sensors of the same priority. */
  weight: number;
  /** The most that its clouds could use on the wire, bit/s; infinite while unknown. */
  usefulBitsPerSecond: number;
}

/**
 * The sensor whose frames are enlarged for a path's probes: the most important one that sends anything.
 *
 * @param claims indexed by sensor number
 * @param wanted sensor numbers
 * @returns its number, or `null` if none of the wanted sensors sends
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
 * Shares a path's rate for clouds among the sensors that its operator wants.
 *
 * @param claims indexed by sensor number
 * @param wanted sensor numbers; those without a claim get nothing
 * @returns the share of `sensor`, bit/s on the wire
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
  // A single sensor is not limited to what it was last known to use: it may be able to use more by now.
  if (rivals.length === 1) return totalBitsPerSecond;
  const rates = allocate(
    totalBitsPerSecond,
    rivals.map(({ number, priority, weight, usefulBitsPerSecond }) => ({
      name: String(number),
      priority,
      weight,
      leastBitsPerSecond: Math.min(LEAST_CLOUD_BITS_PER_SECOND, usefulBitsPerSecond),
      mostBitsPerSecond: usefulBitsPerSecond,
    })),
  );
  return rates.get(String(sensor)) ?? 0;
}
