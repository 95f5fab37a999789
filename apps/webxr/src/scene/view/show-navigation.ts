/** Shows on the floor what the robot's navigator has planned, and its map. */
import type { RobotClient } from '@farpoint/operator';
import { mapView, pathView } from '../../ground/navigation/navigation-view.ts';
import type { CloudAppearance } from '../../state/cloud-appearance.ts';
import type { Stage } from './stage.ts';

/** Call this at the rate of the commands. @param nowMs page's clock */
export function showNavigation(
  { link }: Pick<RobotClient, 'link'>,
  { plan, floorMap }: Pick<Stage, 'plan' | 'floorMap'>,
  { navigation }: Pick<CloudAppearance, 'navigation'>,
  nowMs: number,
): void {
  const { session, phase } = link;
  const isShown = phase === 'live' && navigation.peek();
  const path = isShown ? pathView(session.plannedPath, nowMs) : null;
  const map = isShown ? mapView(session.map, nowMs) : null;
  const ground = session.telemetry?.pose.position.z ?? 0;
  plan.show(path === null || path.stale ? null : path.points, ground);
  floorMap.show(map === null || map.stale ? null : map, ground);
}
