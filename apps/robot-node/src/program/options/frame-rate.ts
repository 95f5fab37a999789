import type { RobotOptionValues } from './robot-program.ts';

/** If not configured. A recording has its own rate, which is kept. */
const DEFAULT_FPS: Partial<Record<RobotOptionValues['source'], number>> = { sim: 60, recording: 120 };

/** The highest rate asked of the source of clouds, 1/s. */
export function framesPerS({ fps, source }: RobotOptionValues): number {
  return fps ?? DEFAULT_FPS[source] ?? 30;
}
