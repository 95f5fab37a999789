/** Which sources can be presented in step: those whose items arrive at about the same time after their capture. */

/** What is needed of a source to decide. */
export interface DelayedSource {
  /** Typical delay from capture to arrival, ms. */
  readonly delayMs: number;
  /** Whether it is in step now. */
  readonly inStep: boolean;
  /** Whether its items are shown only once they are presented. */
  readonly isHeld: boolean;
}

/**
 * A source that is in step leaves the others only when it is farther away than this, so that it does not
 * flutter. Chosen as the margin of a wait (newest-step.ts); step-members.test.ts holds it.
 */
const STAY_MS = 10;

/**
 * Whoever is in step waits for the latest of the group, so a group may not be wider than `widthMs`. Of the groups that
 * are possible, this is the largest, and of equally large ones the one with the shortest delay. Sources that are not held
 * belong to the group if they are as late as its members: they can make others wait, but cannot wait themselves.
 */
export function stepMembers<Source extends DelayedSource>(
  sources: readonly Source[],
  widthMs: number,
): Set<Source> {
  let best: Source[] = [];
  const count = (members: Source[]) => members.filter(({ isHeld }) => isHeld).length;
  for (const { delayMs: first, isHeld } of sources) {
    if (!isHeld) continue;
    const members = sources.filter(({ delayMs, inStep }) => {
      const behindMs = delayMs - first;
      return behindMs >= 0 && behindMs <= widthMs + (inStep ? STAY_MS : 0);
    });
    const isLarger = count(members) > count(best);
    const isEarlier =
      count(members) === count(best) && first < Math.min(...best.map(({ delayMs }) => delayMs));
    if (isLarger || isEarlier) best = members;
  }
  return new Set(best);
}
