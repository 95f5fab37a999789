import { GROUND_CLEARANCE, ROBOT_HEIGHT } from './drive.ts';
import { cos, sin } from './trigonometry.ts';
import type { WorldDescription } from './world.ts';

/** A shape on the floor: a rectangle rotated by (cos, sin), or a disc if both halves are zero. */
export interface Obstacle {
  x: number;
  y: number;
  cos: number;
  sin: number;
  halfLength: number;
  halfWidth: number;
  /** Added on all sides: a disc's radius. */
  margin: number;
}

/** Everything in the world that stands in the robot's way. */
export function staticObstacles(world: WorldDescription): Obstacle[] {
  const reaches = (z: number, height: number) =>
    z - height / 2 < ROBOT_HEIGHT && z + height / 2 > GROUND_CLEARANCE;
  const boxes = world.boxes
    .filter((box) => reaches(box.centre.z, box.size.z))
    .map((box) => ({
      x: box.centre.x,
      y: box.centre.y,
      cos: cos(box.yaw ?? 0),
      sin: sin(box.yaw ?? 0),
      halfLength: box.size.x / 2,
      halfWidth: box.size.y / 2,
      margin: 0,
    }));
  const discs = world.ellipsoids
    .filter((body) => reaches(body.centre.z, body.size.z))
    .map((body) => ({
      x: body.centre.x,
      y: body.centre.y,
      cos: 1,
      sin: 0,
      halfLength: 0,
      halfWidth: 0,
      margin: Math.max(body.size.x, body.size.y) / 2,
    }));
  return [...boxes, ...discs];
}

/** The distance of a point from an obstacle, and the direction away from it; negative inside. */
export interface Separation {
  distance: number;
  normalX: number;
  normalY: number;
}

/** Writes the separation of (x, y) from `obstacle` into `into`. */
export function separation(obstacle: Obstacle, x: number, y: number, into: Separation): Separation {
  return separationWithin(obstacle, x, y, Number.POSITIVE_INFINITY, into) as Separation;
}

/** The same, unless it is `limit` metres or more: then `null`, with less work, and `into` as it was. */
function separationWithin(
  obstacle: Obstacle,
  x: number,
  y: number,
  limit: number,
  into: Separation,
): Separation | null {
  const dx = x - obstacle.x;
  const dy = y - obstacle.y;
  const along = dx * obstacle.cos + dy * obstacle.sin;
  const across = dy * obstacle.cos - dx * obstacle.sin;
  const outAlong = Math.abs(along) - obstacle.halfLength;
  const outAcross = Math.abs(across) - obstacle.halfWidth;
  // No point of a box is nearer than its farther side.
  if (Math.max(outAlong, outAcross) - obstacle.margin >= limit) return null;
  let nAlong: number;
  let nAcross: number;
  if (outAlong > 0 && outAcross > 0) {
    const distance = Math.sqrt(outAlong * outAlong + outAcross * outAcross);
    into.distance = distance - obstacle.margin;
    nAlong = (sign(along) * outAlong) / distance;
    nAcross = (sign(across) * outAcross) / distance;
  } else if (outAlong > outAcross) {
    into.distance = outAlong - obstacle.margin;
    nAlong = sign(along);
    nAcross = 0;
  } else {
    into.distance = outAcross - obstacle.margin;
    nAlong = 0;
    nAcross = sign(across);
  }
  into.normalX = nAlong * obstacle.cos - nAcross * obstacle.sin;
  into.normalY = nAlong * obstacle.sin + nAcross * obstacle.cos;
  return into;
}

function sign(value: number): number {
  return value < 0 ? -1 : 1;
}

/** How often a disc is pushed out of what it overlaps in one step. Chosen: a corner takes two; the rest is for narrow places. */
const MAX_PUSHES = 8;
/** A contact leaves this gap, so that rounding cannot turn it into an overlap. */
const SKIN = 1e-6;

/** Keeps a disc out of obstacles. */
export class CollisionWorld {
  /** Stationary obstacles. */
  readonly fixed: readonly Obstacle[];
  /** Moving obstacles; their owner updates the entries in place. */
  readonly moving: Obstacle[];
  readonly #scratch: Separation = { distance: 0, normalX: 0, normalY: 0 };
  readonly #nearest: Separation = { distance: 0, normalX: 0, normalY: 0 };

  constructor(fixed: readonly Obstacle[], moving: Obstacle[]) {
    this.fixed = fixed;
    this.moving = moving;
  }

  /** Distance from (x, y) to the nearest obstacle's edge; negative inside one. */
  clearance(x: number, y: number): number {
    return this.#find(x, y).distance;
  }

  /**
   * Where a disc of this radius that wants to move from `from` to `to` ends up: there, or slid along an obstacle, or
   * where it was. `from` must be free.
   */
  move(
    from: { x: number; y: number },
    to: { x: number; y: number },
    radius: number,
  ): { x: number; y: number; contact: boolean } {
    let { x, y } = to;
    let contact = false;
    for (let push = 0; push < MAX_PUSHES; push++) {
      const nearest = this.#find(x, y);
      if (nearest.distance >= radius) return { x, y, contact };
      contact = true;
      const depth = radius - nearest.distance + SKIN;
      x += nearest.normalX * depth;
      y += nearest.normalY * depth;
    }
    return this.#find(x, y).distance >= radius ? { x, y, contact } : { ...from, contact };
  }

  #find(x: number, y: number): Separation {
    const nearest = this.#nearest;
    nearest.distance = Number.POSITIVE_INFINITY;
    this.#findIn(this.fixed, x, y);
    this.#findIn(this.moving, x, y);
    return nearest;
  }

  /** Keeps in `#nearest` what is nearer than what is there. */
  #findIn(group: readonly Obstacle[], x: number, y: number): void {
    const nearest = this.#nearest;
    for (const obstacle of group) {
      const found = separationWithin(obstacle, x, y, nearest.distance, this.#scratch);
      if (found === null || found.distance >= nearest.distance) continue;
      nearest.distance = found.distance;
      nearest.normalX = found.normalX;
      nearest.normalY = found.normalY;
    }
  }
}
