/** Where the time of a latency test went, from what the page and the robot each measured. Pure. */
import type { LatencyReport } from '@farpoint/operator';

/** ms. They add up to the whole, motion to photon. */
export interface TestStages {
  /** The input event until the robot had the command. */
  readonly commandMs: number;
  /** Until the robot captured the next frame. */
  readonly waitMs: number;
  /** Until the last packet of that frame had arrived. */
  readonly cloudMs: number;
  /** Until the display frame with it was finished. */
  readonly drawMs: number;
}

export const TEST_STAGES = ['commandMs', 'waitMs', 'cloudMs', 'drawMs'] as const;

/** The clocks are compared no better than this, ms. */
const CLOCK_ERROR_MS = 1;

/**
 * @param offsetMs robot's clock minus page's clock, ms; `null` while it is not known
 * @returns `null` if they cannot be told: the robot's message was lost, or the clocks contradict each other
 */
export function testStages(
  { startedAtMs, arrivedMs, mtpMs, robot }: LatencyReport,
  offsetMs: number | null,
): TestStages | null {
  if (robot === null || offsetMs === null) return null;
  const atRobotMs = robot.commandMs - offsetMs - startedAtMs;
  const capturedMs = robot.captureMs - offsetMs - startedAtMs;
  const stages = {
    commandMs: atRobotMs,
    waitMs: capturedMs - atRobotMs,
    cloudMs: arrivedMs - capturedMs,
    drawMs: mtpMs - arrivedMs,
  };
  return TEST_STAGES.every((stage) => stages[stage] >= -CLOCK_ERROR_MS) ? stages : null;
}
