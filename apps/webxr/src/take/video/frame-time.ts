import { captureMsOfRtp } from '@farpoint/operator';

/**
 * What is farther from now than this was not captured then: its sender counts time otherwise, ms. Chosen:
 * clocks that were compared are never off by so much; older pictures than a minute are nothing to look at.
 */
const MOST_AHEAD_MS = 1000;
const MOST_BEHIND_MS = 60_000;

/** What is known of a frame's time. */
export interface FrameTimes {
  readonly rtpTimestamp: number | null;
  /** Page's clock, ms. */
  readonly capturedAtMs: number | null;
}

/**
 * When a frame was captured: ms on the robot's clock. `null` if it says something that cannot be.
 *
 * @param offsetMs robot's clock minus page's clock
 * @param nowMs page's clock
 */
export function captureMsOf(
  { rtpTimestamp, capturedAtMs }: FrameTimes,
  offsetMs: number,
  nowMs: number,
): number | null {
  const robotNowMs = nowMs + offsetMs;
  const captureMs =
    rtpTimestamp !== null ? captureMsOfRtp(rtpTimestamp, robotNowMs) : (capturedAtMs ?? nowMs) + offsetMs;
  const aheadMs = captureMs - robotNowMs;
  return aheadMs <= MOST_AHEAD_MS && aheadMs >= -MOST_BEHIND_MS ? captureMs : null;
}
