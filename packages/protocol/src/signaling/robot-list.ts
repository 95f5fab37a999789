import type { RobotListing, RobotsChanged } from './farpoint.ts';

/** The list after a change: who stays keeps its place, who is new comes last. The given list is left as it is. */
export function applyRobotsChanged(
  robots: readonly RobotListing[],
  { here, gone }: Pick<RobotsChanged, 'here' | 'gone'>,
): RobotListing[] {
  const byId = new Map(robots.map((robot) => [robot.id, robot]));
  for (const id of gone) byId.delete(id);
  for (const robot of here) byId.set(robot.id, robot);
  return [...byId.values()];
}
