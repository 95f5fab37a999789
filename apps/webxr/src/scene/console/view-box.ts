/**
 * Where things are in the operator's view: degrees to the right and up, as seen from the head, from the way ahead. Keeps them
 * out of each other's way, and out of the way ahead. Pure, allocates nothing after the beginning.
 */

/** Axes of three.js: x right, y up, z back. */
interface Point {
  readonly x: number;
  readonly y: number;
  readonly z: number;
}

export interface Box {
  readonly left: number;
  readonly right: number;
  readonly bottom: number;
  readonly top: number;
}

/** Around the line of sight ahead, which nothing of the console covers, degrees. Chosen: as for the sign before the eyes. */
export const WAY_AHEAD: Box = { left: -15, right: 15, bottom: -15, top: 15 };

const DEGREES = 180 / Math.PI;

/** A box that grows by each point that is added to it. */
export class ViewBox implements Box {
  left = Number.POSITIVE_INFINITY;
  right = Number.NEGATIVE_INFINITY;
  bottom = Number.POSITIVE_INFINITY;
  top = Number.NEGATIVE_INFINITY;

  /** Nothing is in it. */
  clear(): void {
    this.left = Number.POSITIVE_INFINITY;
    this.right = Number.NEGATIVE_INFINITY;
    this.bottom = Number.POSITIVE_INFINITY;
    this.top = Number.NEGATIVE_INFINITY;
  }

  get isEmpty(): boolean {
    return this.left > this.right;
  }

  /**
   * @param point in the space that is tracked
   * @param eyes likewise
   * @param ahead direction of ahead in it, radians to the left
   */
  add(point: Point, eyes: Point, ahead: number): void {
    const [x, y, z] = [point.x - eyes.x, point.y - eyes.y, point.z - eyes.z];
    const cos = Math.cos(ahead);
    const sin = Math.sin(ahead);
    const right = x * cos - z * sin;
    const front = -(z * cos + x * sin);
    const azimuth = Math.atan2(right, front) * DEGREES;
    const elevation = Math.atan2(y, Math.hypot(right, front)) * DEGREES;
    this.left = Math.min(this.left, azimuth);
    this.right = Math.max(this.right, azimuth);
    this.bottom = Math.min(this.bottom, elevation);
    this.top = Math.max(this.top, elevation);
  }
}

/** Whether two boxes cover each other anywhere. One that is empty covers nothing. */
export function covers(a: Box, b: Box): boolean {
  return a.left < b.right && b.left < a.right && a.bottom < b.top && b.bottom < a.top;
}

/** Half the menu's width, degrees: as menu-panel.ts draws it. */
export const MENU_HALF = 14;
/** The menu's middle beside the line of sight, degrees. Chosen: it begins beyond the way ahead, and most headsets show it all. */
const MENU_BESIDE = 30;
/** It is moved by so much more to leave the way ahead free; else it opens on the other side. view-box.test.ts holds it. */
const MOST_MOVED = 15;

/**
 * Where the menu's middle is when it opens: to the left of where the face points, or to the right where it would cover the way
 * ahead.
 *
 * @param face where the face points, seen from above, radians to the left
 * @param ahead likewise
 * @returns radians to the left
 */
export function menuYaw(face: number, ahead: number): number {
  const beside = MENU_BESIDE / DEGREES;
  const least = WAY_AHEAD.right + MENU_HALF;
  const fromAhead = turned(face + beside - ahead) * DEGREES;
  if (Math.abs(fromAhead) >= least) return face + beside;
  return fromAhead >= least - MOST_MOVED ? ahead + least / DEGREES : face - beside;
}

/** To −π…π. */
function turned(angle: number): number {
  return Math.atan2(Math.sin(angle), Math.cos(angle));
}
