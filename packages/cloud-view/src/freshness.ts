/** After this time without points the picture starts to turn grey; {@link STALE_FADE_MS} later it is grey. */
const STALE_AFTER_MS = 600;
const STALE_FADE_MS = 1400;

/** From 1, live, to 0, grey: nobody may take an old picture for the present. @param pointsAtMs when points last came */
export function freshnessAt(nowMs: number, pointsAtMs: number): number {
  const stale = (nowMs - pointsAtMs - STALE_AFTER_MS) / STALE_FADE_MS;
  return 1 - Math.min(Math.max(stale, 0), 1);
}
