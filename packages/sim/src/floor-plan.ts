/** A world's floor as a navigator's map: what is occupied, and the ways between places. */
import { type Obstacle, separation, staticObstacles } from './collision.ts';
import type { WorldDescription } from './world.ts';

/** As in nav_msgs/OccupancyGrid. */
const [OCCUPIED, FREE, UNKNOWN] = [100, 0, -1];
/** Around everything that stands there, nothing is known; metres. */
const MARGIN_M = 0.5;
/** From where ways do not lead, they begin within so many cells. */
const NEAR_CELLS = 3;

/** Cells row by row, x first, from the corner with the least x and y. */
export interface FloorPlan {
  /** Cells along x and y. */
  width: number;
  height: number;
  /** Side of a cell, metres. */
  cellM: number;
  /** The corner with the least x and y. */
  x: number;
  y: number;
  /** 100 occupied, 0 free, -1 unknown. */
  data: Int8Array;
}

/** What stands in the robot's way, without people and carts. @param cellM side of a cell, metres */
export function floorPlan(world: WorldDescription, cellM: number): FloorPlan {
  const obstacles = staticObstacles(world);
  const reaches = obstacles.map(boundsOf);
  const [fromX, fromY] = [
    Math.min(...reaches.map((it) => it.fromX)),
    Math.min(...reaches.map((it) => it.fromY)),
  ];
  const [toX, toY] = [Math.max(...reaches.map((it) => it.toX)), Math.max(...reaches.map((it) => it.toY))];
  const [x, y] = [fromX - MARGIN_M, fromY - MARGIN_M];
  const [width, height] = [Math.ceil((toX + MARGIN_M - x) / cellM), Math.ceil((toY + MARGIN_M - y) / cellM)];
  const plan = { width, height, cellM, x, y, data: new Int8Array(width * height).fill(UNKNOWN) };
  forCells(plan, { fromX, fromY, toX, toY }, (at) => {
    plan.data[at] = FREE;
  });
  for (const obstacle of obstacles) mark(plan, obstacle, cellM / 2, plan.data, OCCUPIED);
  return plan;
}

/** The ways on a plan to one place. */
export class WaysTo {
  readonly #plan: FloorPlan;
  /** Cells on the way to the place; `Infinity` where there is none. */
  readonly #distances: Float64Array;

  /** @param clearanceM how far ways stay away from what is occupied or unknown, metres */
  constructor(plan: FloorPlan, x: number, y: number, clearanceM: number) {
    this.#plan = plan;
    const { width, height, cellM, data } = plan;
    const shut = new Int8Array(data.length);
    data.forEach((value, at) => {
      if (value === FREE) return;
      const centre = {
        x: plan.x + ((at % width) + 0.5) * cellM,
        y: plan.y + (Math.floor(at / width) + 0.5) * cellM,
      };
      const cell = { ...centre, cos: 1, sin: 0, halfLength: 0, halfWidth: 0, margin: 0 };
      mark(plan, cell, clearanceM, shut, 1);
    });
    this.#distances = new Float64Array(data.length).fill(Number.POSITIVE_INFINITY);
    const goal = this.#cellAt(x, y);
    if (goal === null || shut[goal] !== 0) return;
    this.#distances[goal] = 0;
    // Distances spread along the direction of each sweep at once; a round without a change ends it.
    for (let changed = true; changed; ) {
      changed = false;
      for (const backwards of [false, true]) {
        for (let i = 0; i < data.length; i++) {
          const at = backwards ? data.length - 1 - i : i;
          if (shut[at] !== 0) continue;
          const best = this.#best(at, width, height);
          if (best.distance >= (this.#distances[at] as number)) continue;
          this.#distances[at] = best.distance;
          changed = true;
        }
      }
    }
  }

  /** The way from here: places a cell apart, this one first; empty if there is none. */
  from(x: number, y: number): { x: number; y: number }[] {
    const { width, height, cellM } = this.#plan;
    let at = this.#wayFrom(this.#cellAt(x, y));
    if (at === null) return [];
    const way = [{ x, y }];
    while (this.#distances[at] !== 0) {
      at = this.#best(at, width, height).at as number;
      const [column, row] = [at % width, Math.floor(at / width)];
      way.push({ x: this.#plan.x + (column + 0.5) * cellM, y: this.#plan.y + (row + 0.5) * cellM });
    }
    return way;
  }

  /** The cell itself if ways lead through it; else the nearest near it, as where a robot stands too near to something. */
  #wayFrom(cell: number | null): number | null {
    if (cell === null || Number.isFinite(this.#distances[cell])) return cell;
    const { width, height } = this.#plan;
    const [column, row] = [cell % width, Math.floor(cell / width)];
    let nearest: { at: number; cells: number } | null = null;
    for (let y = Math.max(0, row - NEAR_CELLS); y <= Math.min(height - 1, row + NEAR_CELLS); y++) {
      for (let x = Math.max(0, column - NEAR_CELLS); x <= Math.min(width - 1, column + NEAR_CELLS); x++) {
        const cells = Math.hypot(x - column, y - row);
        if (
          Number.isFinite(this.#distances[y * width + x]) &&
          cells < (nearest?.cells ?? Number.POSITIVE_INFINITY)
        )
          nearest = { at: y * width + x, cells };
      }
    }
    return nearest?.at ?? null;
  }

  #cellAt(x: number, y: number): number | null {
    const { width, height, cellM } = this.#plan;
    const [column, row] = [Math.floor((x - this.#plan.x) / cellM), Math.floor((y - this.#plan.y) / cellM)];
    return column >= 0 && column < width && row >= 0 && row < height ? row * width + column : null;
  }

  /** The neighbour by which the place is nearest. */
  #best(at: number, width: number, height: number): { at: number | null; distance: number } {
    const [column, row] = [at % width, Math.floor(at / width)];
    const best: { at: number | null; distance: number } = { at: null, distance: Number.POSITIVE_INFINITY };
    for (let dy = -1; dy <= 1; dy++) {
      for (let dx = -1; dx <= 1; dx++) {
        if ((dx === 0 && dy === 0) || column + dx < 0 || column + dx >= width) continue;
        if (row + dy < 0 || row + dy >= height) continue;
        const next = at + dy * width + dx;
        const distance = (this.#distances[next] as number) + Math.hypot(dx, dy);
        if (distance < best.distance) Object.assign(best, { at: next, distance });
      }
    }
    return best;
  }
}

interface Bounds {
  fromX: number;
  fromY: number;
  toX: number;
  toY: number;
}

function boundsOf({ x, y, cos, sin, halfLength, halfWidth, margin }: Obstacle): Bounds {
  const [c, s] = [Math.abs(cos), Math.abs(sin)];
  const reachX = c * halfLength + s * halfWidth + margin;
  const reachY = s * halfLength + c * halfWidth + margin;
  return { fromX: x - reachX, toX: x + reachX, fromY: y - reachY, toY: y + reachY };
}

/** Marks the cells whose middle is this near to an obstacle. */
function mark(plan: FloorPlan, obstacle: Obstacle, withinM: number, data: Int8Array, value: number): void {
  const { fromX, fromY, toX, toY } = boundsOf(obstacle);
  const wide = { fromX: fromX - withinM, fromY: fromY - withinM, toX: toX + withinM, toY: toY + withinM };
  const into = { distance: 0, normalX: 0, normalY: 0 };
  forCells(plan, wide, (at, x, y) => {
    if (separation(obstacle, x, y, into).distance <= withinM) data[at] = value;
  });
}

function forCells(
  { x, y, cellM, width, height }: FloorPlan,
  { fromX, fromY, toX, toY }: Bounds,
  visit: (at: number, x: number, y: number) => void,
): void {
  const column = (at: number) => Math.min(Math.max(Math.floor((at - x) / cellM), 0), width - 1);
  const row = (at: number) => Math.min(Math.max(Math.floor((at - y) / cellM), 0), height - 1);
  for (let j = row(fromY); j <= row(toY); j++)
    for (let i = column(fromX); i <= column(toX); i++)
      visit(j * width + i, x + (i + 0.5) * cellM, y + (j + 0.5) * cellM);
}
