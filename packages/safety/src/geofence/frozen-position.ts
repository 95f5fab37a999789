/** On the floor, metres. */
interface Point {
  x: number;
  y: number;
}

/**
 * A position may stay behind odometry by so much, besides twice its error, metres: receivers hold still what
 * moves slowly. Chosen: more lets a robot leave its fence by as much. frozen-position.test.ts holds it and
 * the next.
 */
const LAG_M = 1;
/**
 * A position that has changed by so much is not frozen, metres. Chosen: half of the lag, so that one that
 * moves in steps is believed; above what a receiver at rest wanders within seconds.
 */
const MOVED_M = 0.5;
/**
 * After the robot has stood for so long by its odometry, its position is believed again, ms: wheels may have
 * slipped. Chosen: longer than for odometry, because receivers say little of a robot that stands.
 */
const STANDS_MS = 5000;
/** Odometry that has changed by less stands, metres. Chosen: above what it drifts at rest. */
const STANDS_M = 0.05;
/**
 * Each time with half of what it may stay behind; not more often than this allows: four times, a second metre
 * in all.
 */
const LEAST_SHARE = 1 / 16;

/**
 * Tells when a position from outside has stopped moving although the robot has gone on by its odometry, whatever its stamps
 * say. Only distances are compared: the two need not have the same axes.
 */
export class FrozenPosition {
  readonly #mostM: number;
  #share = 1;
  #isFrozen = false;
  /** Both, when the position last moved. */
  #anchor: { position: Point; odometry: Point } | null = null;
  /** Where odometry was, and since when, ms. */
  #standing: { at: Point; sinceMs: number } | null = null;

  /** @param errorM how far off the position may be, metres */
  constructor(errorM: number) {
    this.#mostM = LAG_M + 2 * errorM;
  }

  /** @param atMs when odometry was measured, robot's clock @returns whether the position is not to be believed */
  judge(position: Readonly<Point>, odometry: Readonly<Point>, atMs: number): boolean {
    if (this.#standing === null || distance(this.#standing.at, odometry) > STANDS_M)
      this.#standing = { at: copy(odometry), sinceMs: atMs };
    const stands = atMs - this.#standing.sinceMs >= STANDS_MS;
    const anchor = this.#anchor;
    if (anchor === null || distance(anchor.position, position) >= MOVED_M) {
      this.#begin(position, odometry);
      this.#share = 1;
    } else if (this.#isFrozen && stands && this.#share > LEAST_SHARE) {
      this.#begin(position, odometry);
      this.#share /= 2;
    } else if (distance(anchor.odometry, odometry) > this.#mostM * this.#share) this.#isFrozen = true;
    return this.#isFrozen;
  }

  #begin(position: Readonly<Point>, odometry: Readonly<Point>): void {
    this.#anchor = { position: copy(position), odometry: copy(odometry) };
    this.#isFrozen = false;
  }
}

function copy({ x, y }: Readonly<Point>): Point {
  return { x, y };
}

function distance(one: Readonly<Point>, other: Readonly<Point>): number {
  return Math.hypot(one.x - other.x, one.y - other.y);
}
