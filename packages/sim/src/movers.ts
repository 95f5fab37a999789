import { type Obstacle, type Separation, separation } from './collision.ts';
import { SimulationError } from './errors.ts';
import type { Mover } from './world.ts';

/** Corners of a path are rounded by looking this far ahead and behind, metres. */
const ROUNDING = 0.35;
/** A mover waits if its next step would bring it this close to the robot's edge. */
const COURTESY = 0.3;

const SHAPES = {
  person: { halfLength: 0, halfWidth: 0, margin: 0.27 },
  cart: { halfLength: 0.45, halfWidth: 0.3, margin: 0 },
} as const;

/** One person or cart on its path. It stops for the robot and continues when the way is free. */
export class MovingBody {
  readonly mover: Mover;
  /** Its footprint; x, y, cos and sin are its pose. */
  readonly obstacle: Obstacle;
  /** Distance walked since the start, metres: determines the gait. */
  walked = 0;
  moving = true;
  readonly #path: Path;
  readonly #next = { x: 0, y: 0, cos: 1, sin: 0 };
  readonly #probe: Obstacle;
  readonly #separation: Separation = { distance: 0, normalX: 0, normalY: 0 };

  constructor(mover: Mover) {
    if (mover.path.length < 3) {
      throw new SimulationError(
        'bad-world',
        `mover ${mover.name}`,
        'a closed path has at least three corners',
      );
    }
    this.mover = mover;
    this.#path = new Path(mover.path);
    const shape = SHAPES[mover.kind];
    this.obstacle = { x: 0, y: 0, cos: 1, sin: 0, ...shape };
    this.#probe = { ...this.obstacle };
    this.#path.pose(mover.offset ?? 0, this.obstacle);
  }

  /** Walks for `dt` seconds unless the robot (a disc) is in the way. */
  step(dt: number, robot: { x: number; y: number }, robotRadius: number): void {
    const stride = this.mover.speed * dt;
    this.#path.pose((this.mover.offset ?? 0) + this.walked + stride, this.#next);
    const now = separation(this.obstacle, robot.x, robot.y, this.#separation).distance;
    const then = separation(
      Object.assign(this.#probe, this.#next),
      robot.x,
      robot.y,
      this.#separation,
    ).distance;
    this.moving = then >= robotRadius + COURTESY || (then >= now && then >= robotRadius);
    if (!this.moving) return;
    Object.assign(this.obstacle, this.#next);
    this.walked += stride;
  }
}

/** A closed polyline, measured by the distance along it. */
class Path {
  readonly #corners: readonly { x: number; y: number }[];
  readonly #starts: number[] = [];
  readonly #length: number;

  constructor(corners: readonly { x: number; y: number }[]) {
    this.#corners = corners;
    let length = 0;
    corners.forEach((corner, i) => {
      this.#starts.push(length);
      const next = corners[(i + 1) % corners.length]!;
      length += Math.sqrt((next.x - corner.x) ** 2 + (next.y - corner.y) ** 2);
    });
    this.#length = length;
  }

  /** Position and heading at a distance along the path, corners rounded. */
  pose(distance: number, into: { x: number; y: number; cos: number; sin: number }): void {
    const behind = this.#at(distance - ROUNDING);
    const ahead = this.#at(distance + ROUNDING);
    const dx = ahead.x - behind.x;
    const dy = ahead.y - behind.y;
    const length = Math.sqrt(dx * dx + dy * dy);
    into.x = (behind.x + ahead.x) / 2;
    into.y = (behind.y + ahead.y) / 2;
    if (length > 1e-9) {
      into.cos = dx / length;
      into.sin = dy / length;
    }
  }

  #at(distance: number): { x: number; y: number } {
    const along = ((distance % this.#length) + this.#length) % this.#length;
    let i = this.#starts.length - 1;
    while (i > 0 && this.#starts[i]! > along) i--;
    const from = this.#corners[i]!;
    const to = this.#corners[(i + 1) % this.#corners.length]!;
    const segment = (this.#starts[i + 1] ?? this.#length) - this.#starts[i]!;
    const t = segment > 0 ? (along - this.#starts[i]!) / segment : 0;
    return { x: from.x + (to.x - from.x) * t, y: from.y + (to.y - from.y) * t };
  }
}
