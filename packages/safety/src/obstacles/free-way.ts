import { OWN_BODY_M, type Twist } from '@farpoint/protocol';
import { FloorAround } from './floor-around.ts';
import type { FloorMap } from './floor-map.ts';
import type { Footprint, Nearness, Outline } from './footprint.ts';
import { type FloorPose, floorClasses } from './sensor-grid.ts';

/** How far the robot could go on its arc, at the velocity that is asked for. */
export interface FreeWay {
  /** Until it meets an obstacle or a missing floor, s; infinite if it meets none within the horizon. */
  contactS: number;
  /** What it then meets. */
  cause: 'obstacle' | 'drop-off' | null;
  /** Until it comes to where nothing is known, s; infinite as above. */
  unknownS: number;
}

/** Where the robot is, and what it is to do. */
export interface Sweep {
  pose: Readonly<FloorPose>;
  wish: Readonly<Twist>;
  /** How far to look ahead, s. */
  horizonS: number;
  nowMs: number;
  /** How far the robot has gone, metres: only counts without odometry. */
  travel: number;
}

/**
 * The grown outline moves by at most this share of a cell between two looks, so that no cell is skipped:
 * below half of a cell's diagonal.
 */
const STEP_CELLS = 0.7;
/**
 * Steps that are looked at, so that a command costs a bounded time: 0.11 ms at the 95th percentile (pnpm
 * bench guard).
 */
const MOST_STEPS = 128;
/** Half the diagonal of a cell: how far from its centre its obstacle may be, cells. */
const HALF_DIAGONAL = Math.SQRT1_2;
/**
 * A motion goes towards an obstacle if more than this share of it does. `pnpm bench guard-runs` counts
 * contacts and false stops with this and the shares below.
 */
const TOWARDS = 0.35;
/** And towards an edge of the floor: nothing holds a robot that slips. */
const TOWARDS_EDGE = 0.1;
/** And towards the nearest of all, where that may touch the robot, as far as cells can tell. */
const TOWARDS_TOUCHING = 0.1;
/** What is by less than this farther than the nearest obstacle counts as equally near, cells; and as the nearest itself. */
const NEAREST_CELLS = 0.25;
const SAME_CELLS = 0.02;

/** Sweeps a footprint over the floor. Keeps its buffers: one per guard. */
export class FreeWaySearch {
  readonly #map: FloorMap;
  readonly #footprint: Footprint;
  /** From the widest to the narrowest, which is the footprint itself. */
  readonly #outlines: readonly Outline[];
  readonly #leading: Float64Array;
  readonly #around: FloorAround;
  readonly #near: Nearness = { distance: 0, x: 0, y: 0 };
  readonly #way: FreeWay = { contactS: 0, cause: null, unknownS: 0 };

  /** @param margins metres, from the widest to the narrowest; the footprint itself follows */
  constructor(map: FloorMap, footprint: Footprint, margins: readonly number[]) {
    this.#map = map;
    this.#around = new FloorAround(map);
    this.#footprint = footprint;
    const spacing = map.cellM * STEP_CELLS;
    this.#outlines = [...margins, 0].map((margin) => footprint.outline(margin, spacing));
    this.#leading = new Float64Array(Math.max(...this.#outlines.map(({ points }) => points.length)));
  }

  /**
   * How far the footprint, grown by the margin of that index, can go. If something is already within the margin, the
   * margin shrinks until nothing is: the robot may go along an obstacle, and away from it. For a missing floor it does not
   * shrink: the robot may only go away from it.
   *
   * @returns an object that the next call overwrites
   */
  look(sweep: Sweep, index: number): Readonly<FreeWay> {
    const way = this.#way;
    [way.contactS, way.cause, way.unknownS] = [Number.POSITIVE_INFINITY, null, Number.POSITIVE_INFINITY];
    const speed = this.speedOf(sweep.wish);
    if (!(speed > 0)) return way;
    const level = this.#levelAt(sweep, index);
    this.#advance(sweep, this.#outlines[level] as Outline, speed);
    return way;
  }

  /**
   * What a motion brings the robot nearer to, of what is nearest within a margin; `null` if nothing.
   *
   * @param index of the margin for obstacles @param edgeIndex of that for a missing floor
   */
  deeper(sweep: Sweep, index: number, edgeIndex: number): 'obstacle' | 'drop-off' | null {
    return (
      this.#deeper(sweep, edgeIndex, floorClasses.dropOff, TOWARDS_EDGE) ??
      this.#deeper(sweep, index, floorClasses.occupied, TOWARDS)
    );
  }

  #deeper(sweep: Sweep, index: number, kind: number, towards: number): 'obstacle' | 'drop-off' | null {
    const { wish } = sweep;
    const { margin } = this.#outlines[index] as Outline;
    let least = Number.POSITIVE_INFINITY;
    this.#within(margin, sweep, (_x, _y, { distance }, known) => {
      if (known === kind) least = Math.min(least, distance);
    });
    if (least === Number.POSITIVE_INFINITY) return null;
    const { cellM } = this.#map;
    const mayTouch = least < HALF_DIAGONAL * cellM;
    let found: 'obstacle' | 'drop-off' | null = null;
    this.#within(margin, sweep, (x, y, near, known) => {
      // What lies ahead along a wall comes no nearer than the wall is: the sweep looks after the rest.
      if (known !== kind || near.distance > least + NEAREST_CELLS * cellM) return;
      // How a thing that stands still moves, seen from the robot.
      const dx = -wish.linear.x + wish.angular.z * y;
      const dy = -wish.linear.y - wish.angular.z * x;
      const isNearest = near.distance <= least + SAME_CELLS * cellM;
      const most = mayTouch && isNearest ? Math.min(towards, TOWARDS_TOUCHING) : towards;
      if (near.x * dx + near.y * dy < -most * Math.hypot(dx, dy)) found ??= causeOf(known);
    });
    return found;
  }

  /** The highest speed of any point of the footprint, m/s. */
  speedOf({ linear, angular }: Readonly<Twist>): number {
    return Math.hypot(linear.x, linear.y) + Math.abs(angular.z) * this.#footprint.reach;
  }

  /** The widest outline from `index` on that touches no obstacle. */
  #levelAt(sweep: Sweep, index: number): number {
    let level = index;
    const last = this.#outlines.length - 1;
    this.#within((this.#outlines[index] as Outline).margin, sweep, (_x, _y, { distance }, known) => {
      if (known === floorClasses.dropOff) return;
      const slack = distance - HALF_DIAGONAL * this.#map.cellM;
      while (level < last && slack < (this.#outlines[level] as Outline).margin) level++;
    });
    return level;
  }

  /** Visits the cells within a margin where the robot must not go, with their place in base_link. */
  #within(
    margin: number,
    { pose, nowMs, travel }: Sweep,
    visit: (x: number, y: number, near: Nearness, known: number) => void,
  ): void {
    const map = this.#map;
    const grown = margin + HALF_DIAGONAL * map.cellM;
    const reach = this.#footprint.reach + grown;
    const [cos, sin] = [Math.cos(pose.yaw), Math.sin(pose.yaw)];
    this.#around.read(pose, reach, nowMs, travel);
    const { classes, cells } = this.#around;
    const { left, low, width, height } = cells;
    for (let at = 0; at < width * height; at++) {
      const known = classes[at] as number;
      if (known !== floorClasses.occupied && known !== floorClasses.dropOff) continue;
      const [i, j] = [left + (at % width), low + Math.floor(at / width)];
      const [dx, dy] = [(i + 0.5) * map.cellM - pose.x, (j + 0.5) * map.cellM - pose.y];
      const [x, y] = [dx * cos + dy * sin, dy * cos - dx * sin];
      if (x * x + y * y >= reach * reach) continue;
      const near = this.#footprint.nearness(x, y, this.#near);
      if (near.distance < grown && near.distance > -OWN_BODY_M) visit(x, y, near, known);
    }
  }

  #advance({ pose, wish, horizonS, nowMs, travel }: Sweep, outline: Outline, speed: number): void {
    const [map, way] = [this.#map, this.#way];
    const { cellM } = map;
    const count = this.#lead(outline, wish);
    const stepS = (STEP_CELLS * cellM) / speed;
    const steps = Math.min(Math.ceil(horizonS / stepS), MOST_STEPS);
    let { x, y, yaw } = pose;
    const turn = wish.angular.z * stepS;
    const per = 1 / cellM;
    for (let step = 1; step <= steps; step++) {
      const heading = yaw + turn / 2;
      const [hc, hs] = [Math.cos(heading) * stepS, Math.sin(heading) * stepS];
      x += wish.linear.x * hc - wish.linear.y * hs;
      y += wish.linear.x * hs + wish.linear.y * hc;
      yaw += turn;
      const [cos, sin] = [Math.cos(yaw), Math.sin(yaw)];
      for (let k = 0; k < count; k += 2) {
        const [px, py] = [this.#leading[k] as number, this.#leading[k + 1] as number];
        const i = Math.floor((x + px * cos - py * sin) * per);
        const j = Math.floor((y + px * sin + py * cos) * per);
        const known = map.classAt(i, j, nowMs, travel);
        if (known === floorClasses.free) continue;
        if (known === floorClasses.unknown && way.unknownS < Number.POSITIVE_INFINITY) continue;
        if (this.#covered(i, j, pose, outline.margin)) continue;
        const atS = (step - 1) * stepS;
        if (known === floorClasses.unknown) {
          way.unknownS = atS;
          continue;
        }
        const nearer = Math.max(0, atS - map.travelSince(i, j, nowMs, travel) / speed);
        if (nearer >= way.contactS) continue;
        way.contactS = nearer;
        way.cause = causeOf(known);
      }
      if (way.contactS < Number.POSITIVE_INFINITY) return;
    }
    // Farther than it looks, nothing is known.
    if (steps === MOST_STEPS) way.unknownS = Math.min(way.unknownS, steps * stepS);
  }

  /** Collects the points of the outline that do not move backwards. @returns twice their number */
  #lead({ points }: Outline, { linear, angular }: Readonly<Twist>): number {
    let count = 0;
    for (let k = 0; k < points.length; k += 4) {
      const [x, y] = [points[k] as number, points[k + 1] as number];
      const [nx, ny] = [points[k + 2] as number, points[k + 3] as number];
      const vx = linear.x - angular.z * y;
      const vy = linear.y + angular.z * x;
      if (vx * nx + vy * ny < -1e-9) continue;
      this.#leading[count] = x;
      this.#leading[count + 1] = y;
      count += 2;
    }
    return count;
  }

  /** Whether the robot with this margin already stands over a cell. */
  #covered(i: number, j: number, pose: Readonly<FloorPose>, margin: number): boolean {
    const { cellM } = this.#map;
    const [dx, dy] = [(i + 0.5) * cellM - pose.x, (j + 0.5) * cellM - pose.y];
    const [cos, sin] = [Math.cos(pose.yaw), Math.sin(pose.yaw)];
    const [x, y] = [dx * cos + dy * sin, dy * cos - dx * sin];
    return this.#footprint.isWithin(x, y, margin + HALF_DIAGONAL * cellM, this.#near);
  }
}

function causeOf(known: number): 'obstacle' | 'drop-off' {
  return known === floorClasses.dropOff ? 'drop-off' : 'obstacle';
}
