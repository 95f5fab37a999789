import type { GoalReason } from '@farpoint/protocol';
import { clearance, type Fence, type FencePose } from '@farpoint/safety';

/**
 * Why a goal is not one that the fence permits; `null`: it is.
 *
 * @param radiusM around base_link that holds the whole robot, m
 * @param pose of the robot in the fence's frame; `null` if it is unknown
 * @param robot the same place in odometry's frame, in which the goal is, m
 */
export function goalInFence(
  fence: Fence,
  radiusM: number,
  pose: FencePose | null,
  robot: Readonly<{ x: number; y: number }>,
  goal: Readonly<{ x: number; y: number }>,
): GoalReason | null {
  if (pose === null) return 'no-pose';
  const keepOff = radiusM + pose.errorM;
  // A satellite receiver does not tell how odometry's frame lies on the earth: the goal may be in any direction.
  const room =
    pose.yaw === null
      ? clearance(fence, pose.x, pose.y) - Math.hypot(goal.x - robot.x, goal.y - robot.y)
      : clearance(fence, goal.x, goal.y);
  // Written so that NaN is outside.
  return room >= keepOff ? null : 'outside-fence';
}
