/** Shows on the floor what the robot takes of it, and where the operator's hand leads it. */
import type { RobotClient } from '@farpoint/operator';
import type { DrivenPath, PathTone } from './drive-path.ts';
import type { Stage } from './stage.ts';

/** Call this at the rate of the commands. */
export function showDrivePath(client: RobotClient, stage: Stage): void {
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
  return { linear: asked.linear.x, angular: asked.angular.z, loopMs: viewAgeMs, tone };
}
