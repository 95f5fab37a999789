/** What one stream asks of a path that several streams share. Rates are on the wire, including headers, bit/s. */
export interface StreamClaim {
  name: string;
  /** Lower values are served first; 0 for what keeps the robot safe. */
  priority: number;
  /** Relative share among streams of the same priority. */
  weight: number;
  /** Below this rate, the stream is useless. Every stream gets its minimum before any stream gets more. */
  leastBitsPerSecond: number;
  /** The stream cannot use more than this. */
  mostBitsPerSecond: number;
}

/**
 * Shares one budget. First each stream gets its minimum, in order of priority. Then the rest is distributed, again in
 * order of priority and by weight within a priority, up to each stream's maximum. The sum never exceeds the total.
 *
 * @param claims with distinct names
 * @returns bit/s by name
 */
export function allocate(totalBitsPerSecond: number, claims: readonly StreamClaim[]): Map<string, number> {
  const given = new Map(claims.map(({ name }) => [name, 0]));
  let left = Math.max(totalBitsPerSecond, 0);
  const inOrder = claims.toSorted((a, b) => a.priority - b.priority);
  for (const { name, leastBitsPerSecond, mostBitsPerSecond } of inOrder) {
    const rate = Math.min(leastBitsPerSecond, mostBitsPerSecond, left);
    given.set(name, rate);
    left -= rate;
  }
  for (const priority of new Set(inOrder.map((claim) => claim.priority))) {
    left = fill(
      left,
      inOrder.filter((claim) => claim.priority === priority && claim.weight > 0),
      given,
    );
  }
  return given;
}

/** Fills streams of one priority by weight; a full stream leaves the rest to the others. @returns what is left */
function fill(total: number, claims: readonly StreamClaim[], given: Map<string, number>): number {
  let left = total;
  let open = claims;
  while (open.length > 0 && left > 0) {
    const weights = open.reduce((sum, { weight }) => sum + weight, 0);
    const room = ({ name, mostBitsPerSecond }: StreamClaim) =>
      mostBitsPerSecond - (given.get(name) as number);
    const full = open.filter((claim) => room(claim) <= (left * claim.weight) / weights);
    if (full.length === 0) {
      for (const { name, weight } of open)
        given.set(name, (given.get(name) as number) + (left * weight) / weights);
      return 0;
    }
    for (const claim of full) {
      left -= room(claim);
      given.set(claim.name, claim.mostBitsPerSecond);
    }
    open = open.filter((claim) => !full.includes(claim));
  }
  return left;
}
