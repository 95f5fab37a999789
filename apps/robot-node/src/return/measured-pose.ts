import type { TimedBaseState } from '../base/base.ts';

/** The pose of base_link on the floor, m and rad, and when it was measured, robot's clock, ms. */
export interface MeasuredPose {
  pose: { x: number; y: number; yaw: number };
  measuredMs: number;
}

/**
 * @param isSimulated whether the base is simulated: then its state was measured at its time. Others say when
 * @returns `null` if nobody knows when it was measured
 */
export function measuredPose(
  { pose, timeMs, measuredMs }: TimedBaseState,
  isSimulated: boolean,
): MeasuredPose | null {
  const atMs = measuredMs ?? (isSimulated ? timeMs : null);
  if (atMs === null) return null;
  const { x, y, z, w } = pose.orientation;
  const yaw = Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
  return { pose: { x: pose.position.x, y: pose.position.y, yaw }, measuredMs: atMs };
}
