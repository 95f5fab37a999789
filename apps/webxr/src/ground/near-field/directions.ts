/** Directions around the robot, in the eighths of a circle that people name. */
import type { NearKind, NearSector } from '@farpoint/operator';

/** Counter-clockwise from straight ahead. */
const NAMES = [
  'ahead',
  'ahead left',
  'left',
  'behind left',
  'behind',
  'behind right',
  'right',
  'ahead right',
] as const;
export type Direction = (typeof NAMES)[number];

/**
 * Unseen floor nearer than this is where the robot would go next, metres. Chosen: a second at the 0.3 m/s
 * that are allowed there, and its way to stand.
 */
const UNSEEN_NEAR_M = 0.5;
/** A shorter stretch is drawn, but not named, metres. Chosen: about a robot and its margins. */
const UNSEEN_LONG_M = 1;

export interface NearHit {
  direction: Direction;
  kind: NearKind;
  metres: number;
}

/** The direction of a sector. @param count how many sectors there are */
export function directionOf(sector: number, count: number): Direction {
  return NAMES[Math.round((sector * NAMES.length) / count) % NAMES.length] as Direction;
}

/** What is nearest in each direction in which something is, the nearest first. */
export function nearestHits(sectors: readonly NearSector[]): NearHit[] {
  const nearest = new Map<Direction, NearHit>();
  for (const [i, { hit }] of sectors.entries()) {
    if (hit === null) continue;
    const direction = directionOf(i, sectors.length);
    if (hit.metres < (nearest.get(direction)?.metres ?? Number.POSITIVE_INFINITY))
      nearest.set(direction, { direction, ...hit });
  }
  return [...nearest.values()].sort((a, b) => a.metres - b.metres);
}

/** The directions of which most is unseen near the robot. One that lies between two others of them is not named. */
export function unseenDirections(sectors: readonly NearSector[]): Direction[] {
  const unseen = new Map<Direction, number>();
  for (const [i, { hit, unseen: stretch }] of sectors.entries()) {
    if (stretch === null || stretch.fromM > UNSEEN_NEAR_M) continue;
    // What is unseen behind a thing is behind it; and the floor just before a robot is often out of its view.
    if (hit !== null && hit.metres <= stretch.fromM) continue;
    if (stretch.toM - stretch.fromM < UNSEEN_LONG_M) continue;
    const direction = directionOf(i, sectors.length);
    unseen.set(direction, (unseen.get(direction) ?? 0) + 1);
  }
  const most = sectors.length / NAMES.length / 2;
  const isUnseen = (i: number) =>
    (unseen.get(NAMES[(i + NAMES.length) % NAMES.length] as Direction) ?? 0) > most;
  return NAMES.filter((_, i) => isUnseen(i) && !(i % 2 === 1 && isUnseen(i - 1) && isUnseen(i + 1)));
}
