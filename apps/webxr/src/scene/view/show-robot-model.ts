/** Shows what the robot looks like. */
import type { RobotClient } from '@farpoint/operator';
import type { CloudAppearance } from '../../state/cloud-appearance.ts';
import type { Stage } from './stage.ts';

/** Call this at the rate of the commands. */
export function showRobotModel(
  { link }: Pick<RobotClient, 'link'>,
  { figures }: Pick<Stage, 'figures'>,
  { model }: Pick<CloudAppearance, 'model'>,
): void {
  figures.show(link.phase === 'live' && model.peek() ? link.session.model : null);
}
