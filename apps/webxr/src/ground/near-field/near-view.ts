/** What of the near field is shown: a picture of the past is shown as such, and then no longer. */
import type { NearSector, NearSurroundings } from '@farpoint/operator';

/**
 * The robot repeats itself twice a second: without two of these, what was told is old, ms. near-view.test.ts
 * holds it.
 */
const STALE_MS = 1000;
/**
 * And then it is nothing to go by, ms: as long as the robot remembers a free floor (docs/obstacle-guard.md).
 */
const GONE_MS = 3000;

export interface NearView {
  readonly sectors: readonly NearSector[];
  /** Whether it is old. */
  readonly stale: boolean;
  /** How old, ms. */
  readonly ageMs: number;
}

/**
 * What can be shown; `null` if there is nothing, or nothing any more.
 *
 * @param at.nowMs page's clock @param at.offsetMs what the robot's clock is ahead of it; `null` while unknown
 * @param at.heard whether the robot is heard: what it does not repeat is old at once
 */
export function nearView(
  near: NearSurroundings,
  { nowMs, offsetMs, heard }: { nowMs: number; offsetMs: number | null; heard: boolean },
): NearView | null {
  const ageMs = near.ageMs(nowMs, offsetMs);
  if (ageMs === null || ageMs > GONE_MS) return null;
  return { sectors: near.sectors, stale: !heard || ageMs > STALE_MS, ageMs };
}
