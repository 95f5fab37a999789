/** Shows what is known of the robot in its place: its body and way on the floor, its navigator's plan and map, its model. */
import type { RobotClient } from '@farpoint/operator';
import { mapView, pathView } from '../../ground/navigation/navigation-view.ts';
import type { CloudAppearance } from '../../state/cloud-appearance.ts';
import type { DrivenPath, PathTone } from './drive-path.ts';
import type { Stage } from './stage.ts';

export interface ShownRobot {
  readonly client: RobotClient;
  readonly stage: Stage;
  readonly appearance: CloudAppearance;
}

/**
 * Shows where everything about the robot is now. Call it at the rate of the commands.
 *
 * @param nowMs page's clock
 */
export function showRobot({ client, stage, appearance }: ShownRobot, nowMs: number): void {
  showRobotModel(client, stage, appearance);
  showDrivePath(client, stage);
  showNavigation(client, stage, appearance, nowMs);
}

/** Shows on the floor where the operator's hand leads the robot. */
function showDrivePath(client: RobotClient, stage: Stage): void {
  const { session, phase } = client.link;
  const live = phase === 'live';
  stage.robotBody = (live ? session.welcome?.body : null) ?? null;
  stage.path.show(live ? drivenPath(client) : null);
}

function drivenPath({ driver, link }: RobotClient): DrivenPath | null {
  const { asked } = driver.stream;
  if (asked === null) return null;
  const { telemetry, estop } = link.session;
  const { factor = 1, viewAgeMs } = telemetry?.motion ?? {};
  const tone: PathTone = estop.latched || factor === 0 ? 'held' : factor < 1 ? 'slower' : 'free';
  const { x: linear, y: lateral } = asked.linear;
  return { linear, lateral, angular: asked.angular.z, loopMs: viewAgeMs, tone };
}

/** Shows on the floor what the robot's navigator has planned, and its map. */
function showNavigation(
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

/** Shows what the robot looks like. */
function showRobotModel(
  { link }: Pick<RobotClient, 'link'>,
  { figures }: Pick<Stage, 'figures'>,
  { model }: Pick<CloudAppearance, 'model'>,
): void {
  figures.show(link.phase === 'live' && model.peek() ? link.session.model : null);
}
