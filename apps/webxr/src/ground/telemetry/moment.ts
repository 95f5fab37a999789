/** The instant whose values are shown, and how old they are. */
import type { Series } from './series.ts';

export interface Moment {
  /** The capture instant of what is presented, robot's clock, ms; `null` to show the newest values. */
  readonly instantMs: number | null;
  /** The robot's clock now, ms. */
  readonly robotNowMs: number;
  /** Whether the robot is heard: otherwise every value is stale. */
  readonly heard: boolean;
}

/** A value as it is shown at a moment. */
export interface ShownValue {
  readonly value: number;
  readonly ageMs: number;
  /** It should have been replaced long ago, by its own rate, or nothing comes from the robot at all. */
  readonly stale: boolean;
}

/** @returns `null` if nothing has come */
export function shownAt(
  series: Series | undefined,
  { instantMs, robotNowMs, heard }: Moment,
): ShownValue | null {
  if (series === undefined) return null;
  // What was first measured after the instant is not hidden: there is nothing older to show.
  const shown = (instantMs === null ? null : series.at(instantMs)) ?? series.at(Number.POSITIVE_INFINITY);
  if (shown === null) return null;
  const ageMs = Math.max(0, robotNowMs - shown.timeMs);
  // What is presented is always a little old; that alone makes no value stale.
  const presentedMs = instantMs === null ? 0 : Math.max(0, robotNowMs - instantMs);
  return { value: shown.value, ageMs, stale: !heard || ageMs > series.staleMs + presentedMs };
}
