/** The earliest and the latest time, 0 if there are none; bigint has no `Math.min`. */
export function timeRange(times: Iterable<bigint>): { first: bigint; last: bigint } {
  let [first, last]: [bigint | null, bigint | null] = [null, null];
  for (const time of times) {
    if (first === null || time < first) first = time;
    if (last === null || time > last) last = time;
  }
  return { first: first ?? 0n, last: last ?? 0n };
}
