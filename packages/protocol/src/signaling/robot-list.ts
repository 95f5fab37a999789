import type { RobotListing, RobotsChanged } from './farpoint.ts';

/**
 * The list after a change: remaining robots keep their places, new ones are appended. The given list is not modified.
 */
export function applyRobotsChanged(
  robots: readonly RobotListing[],
  { here, gone }: Pick<RobotsChanged, 'here' | 'gone'>,
): RobotListing[] {
  const byId = new Map(robots.map((robot) => [robot.id, robot]));
  for (const id of gone) byId.delete(id);
  for (const robot of here) byId.set(robot.id, robot);
  return [...byId.values()];
}
