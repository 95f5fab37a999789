/** Checks whether the robot will remember its emergency stop, its key and revoked grants. */
import type { RobotOptions } from '../robot-configuration.ts';
import { fleetingState, placeText, STATE_REMEDY } from '../state-place.ts';
import { ok, type Result, warn } from './finding.ts';

export function checkState(options: Pick<RobotOptions, 'stateFolder' | 'robotKey' | 'audit'>): Result[] {
  const places = fleetingState(options);
  if (places.length === 0) return [ok(`${options.stateFolder} is kept`)];
  return places.map((place) => warn(placeText(place), STATE_REMEDY));
}
