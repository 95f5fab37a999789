import type { RobotStop } from '@farpoint/protocol';
import type { RobotStopState } from '@farpoint/safety';

/**
 * Time for which a stop that repeats itself must say go before it counts, ms. Chosen: contacts bounce for
 * some milliseconds, bad ones for tens; who releases does not notice the wait.
 */
export const STEADY_MS = 250;

/** A stop at the robot itself. */
export interface StopSource {
  readonly stop: RobotStop;
  /** What it is, for people: `topic /stop`. */
  readonly name: string;
  /** Why it cannot be read, for people; `null` while it can. */
  readonly fault: string | null;
  /** Called when it may say something else; it is looked at every few milliseconds anyway. */
  onChange: (() => void) | null;
  /** Reads it, and judges what it says. Never throws. @param nowMs the robot's monotonic clock */
  look(nowMs: number): RobotStopState;
  close(): void | Promise<void>;
}
