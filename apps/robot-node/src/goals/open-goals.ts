import type { Logger } from '@farpoint/service';
import type { GoalConfiguration } from './goal-configuration.ts';
import { GoalStation, type GoalStationParts } from './goal-station.ts';
import { RosNavigator } from './ros-navigator.ts';
import { SimNavigator } from './sim-navigator.ts';

/** @returns `null` if the robot takes no goals */
export function openGoals(
  configuration: GoalConfiguration | undefined,
  parts: Omit<GoalStationParts, 'navigator'> & { log: Logger },
): GoalStation | null {
  if (configuration === undefined) return null;
  const { navigator: options } = configuration;
  const navigator = options.kind === 'sim' ? new SimNavigator() : new RosNavigator(options, parts.log);
  return new GoalStation(configuration, { ...parts, navigator });
}
