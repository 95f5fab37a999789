/** Whether what the page shows of the robot is live. */
import type { RobotClient } from '@farpoint/operator';
import { UNHEARD_MS } from '../status/silence.ts';

/** Something has come from the robot just now. @param atMs page's clock */
export function isHeard(link: Pick<RobotClient['link'], 'phase' | 'silentMs'>, atMs: number): boolean {
  return link.phase === 'live' && link.silentMs(atMs) < UNHEARD_MS;
}
