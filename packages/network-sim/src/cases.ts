/**
 * How many cases long tests try, and which. All that is random in a test is seeded, so every run meets the same cases;
 * `FAST_CHECK_SEED` gives others. A long test tries a quarter of its cases, so that whoever changes something waits for
 * less than a minute, and all of them with `FARPOINT_LONG_TESTS`, as `pnpm soak` does.
 */
const SHARE = shareInEachRun(1 / 4);

/** All of them with `FARPOINT_LONG_TESTS`, and otherwise this share: of cases that each take longer, or less, than most. */
export function shareInEachRun(share: number): number {
  return process.env.FARPOINT_LONG_TESTS ? 1 : share;
}

/** Of properties that have no seed of their own. */
export const PROPERTY_SEED = Number(process.env.FAST_CHECK_SEED ?? 1);

/** How many of a long test's cases are tried now: at least one. */
export function casesOf(all: number, share = SHARE): number {
  return Math.max(1, Math.ceil(all * share));
}

/** Those of a long test's cases that are tried now. @param from which of the first ones begins, so that lists differ */
export function someOf<T>(all: readonly T[], from = 0, share = SHARE): T[] {
  const every = Math.round(1 / share);
  const some = all.filter((_, index) => (index + from) % every === 0);
  return some.length > 0 ? some : all.slice(0, 1);
}

/** The parameters of a long property. @param seed its own @param all how many cases it has */
export function longProperty(
  seed: number,
  all: number,
  { share = SHARE, propertySeed = PROPERTY_SEED } = {},
): { seed: number; numRuns: number } {
  return { seed: seed + propertySeed - 1, numRuns: casesOf(all, share) };
}
