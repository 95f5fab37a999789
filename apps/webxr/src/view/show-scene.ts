/** Shows in the scene what the robot says of itself and of its surroundings. */
import type { RobotClient } from '@farpoint/operator';
import { showRobotModel } from '../robot-model/show-robot-model.ts';
import type { CloudAppearance } from '../state/cloud-appearance.ts';
import { showDrivePath } from './show-drive-path.ts';
import { showNavigation } from './show-navigation.ts';
import type { NearFieldDisplay } from './show-near-field.ts';
import type { Stage } from './stage.ts';

/** Call this at the rate of the commands. @param nowMs page's clock */
export function showScene(
  parts: { client: RobotClient; stage: Stage; appearance: CloudAppearance; near: NearFieldDisplay },
  nowMs: number,
): void {
  const { client, stage, appearance, near } = parts;
  showRobotModel(client, stage, appearance);
  showDrivePath(client, stage);
  showNavigation(client, stage, appearance, nowMs);
  near.tick(nowMs);
}
