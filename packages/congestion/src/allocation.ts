/** What one stream asks of a path that several share. Rates on the wire, headers counted, bit/s. */
export interface StreamClaim {
  name: string;
  /** Lower goes first: 0 for what keeps the robot safe. */
  priority: number;
  /** Share among streams of the same priority. */
  weight: number;
  /** Below this the stream is no use: given before anybody gets more than their least. */
  leastBitsPerSecond: number;
  /** More it cannot use. */
  mostBitsPerSecond: number;
}

/**
 * Shares one budget: first everybody's least, in order of priority; then what is left, again in order of priority and by
 * weight within one, up to everybody's most. Nothing is given twice, and never more than there is.
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

/** Fills streams of one priority by weight; who is full leaves the rest to the others. @returns what is left */
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
