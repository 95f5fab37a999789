import type { RobotClient } from '@farpoint/operator';

/**
 * Age of what the operator sees, ms: as the robot judges it while commands come, with the way to the robot and back;
 * otherwise since the capture of the newest that is on the screen. `null` while nothing is seen.
 */
export function viewAgeMs({ link, seen }: Pick<RobotClient, 'link' | 'seen'>, nowMs: number): number | null {
  const judgedMs = link.session.telemetry?.motion?.viewAgeMs;
  if (judgedMs !== undefined) return judgedMs;
  return seen.stampUs === null ? null : link.session.ageMs(seen.stampUs, nowMs);
}
