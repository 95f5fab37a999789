/** To which side the robot's front is, where the operator does not see it. Pure. */
import { shortestTurn } from '../pose-follower.ts';

/** A front within this angle of where the face points is in view, radians. */
const IN_VIEW = (40 * Math.PI) / 180;

/**
 * @param front the robot's heading, radians, positive to the left
 * @param face where the operator's face points, likewise
 * @returns −1: to the left, 1: to the right, 0: in view
 */
export function frontSide(front: number, face: number): -1 | 0 | 1 {
  const away = shortestTurn(front - face);
  if (!(Math.abs(away) > IN_VIEW)) return 0;
  return away > 0 ? -1 : 1;
}
