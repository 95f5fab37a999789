import { NEAR_REACH_M, NEAR_SECTORS, NEAR_UNSEEN_M, type NearSector, OWN_BODY_M } from '@farpoint/protocol';
import { FloorAround } from './floor-around.ts';
import type { FloorMap } from './floor-map.ts';
import type { Footprint, Nearness } from './footprint.ts';
import { type FloorPose, floorClasses } from './sensor-grid.ts';

const SECTOR = (2 * Math.PI) / NEAR_SECTORS;
/**
 * An unseen stretch ends where the floor is seen again for so long, metres: shorter ones are gaps in what is
 * seen. Chosen: four cells.
 */
const SEEN_AGAIN_M = 0.2;

/** Of the table of distances, metres: half a cell, so that it adds no error to theirs. */
const TABLE_M = 0.025;

/** Finds what is nearest to a footprint in each direction. Keeps its buffers: one per guard. */
export class NearFieldSearch {
  readonly #map: FloorMap;
  readonly #footprint: Footprint;
  readonly #near: Nearness = { distance: 0, x: 0, y: 0 };
  readonly #hitM = new Float64Array(NEAR_SECTORS);
  readonly #isDrop = new Uint8Array(NEAR_SECTORS);
  /** Of each sector and each cell's length of distance: whether some floor there is unseen. */
  readonly #unseen: Uint8Array;
  /** How many lengths there are. */
  readonly #rings: number;
  /** How far from base_link unseen floor is looked for, metres. */
  readonly #unseenReach: number;
  /** Distances from the footprint in base_link: there is much unseen floor. Made when it is first needed. */
  #distances: Float32Array | null = null;
  readonly #tableSide: number;
  readonly #around: FloorAround;

  constructor(map: FloorMap, footprint: Footprint) {
    this.#map = map;
    this.#around = new FloorAround(map);
    this.#footprint = footprint;
    this.#rings = Math.ceil(NEAR_UNSEEN_M / map.cellM);
    this.#unseen = new Uint8Array(NEAR_SECTORS * this.#rings);
    this.#unseenReach = footprint.reach + NEAR_UNSEEN_M + map.cellM;
    this.#tableSide = 2 * Math.ceil(this.#unseenReach / TABLE_M) + 3;
  }

  /**
   * Looks around.
   *
   * @param travel how far the robot has gone, metres: only counts without odometry
   * @returns of each sector, by the protocol's numbers
   */
  look(pose: Readonly<FloorPose>, nowMs: number, travel: number): NearSector[] {
    this.#around.read(pose, this.#footprint.reach + NEAR_REACH_M + this.#map.cellM, nowMs, travel);
    this.#findHits(pose, nowMs, travel);
    this.#findUnseen(pose);
    return Array.from({ length: NEAR_SECTORS }, (_, i) => {
      const hit = this.#hitM[i] as number;
      const kind = this.#isDrop[i] === 1 ? 'drop' : 'thing';
      return {
        hit: hit <= NEAR_REACH_M ? { kind, metres: hit } : null,
        unseen: this.#stretch(i),
      };
    });
  }

  #findHits(pose: Readonly<FloorPose>, nowMs: number, travel: number): void {
    const map = this.#map;
    const { cellM } = map;
    const { classes, cells } = this.#around;
    const { left, low, width, height } = cells;
    this.#hitM.fill(Number.POSITIVE_INFINITY);
    const [cos, sin] = [Math.cos(pose.yaw), Math.sin(pose.yaw)];
    const reach = this.#footprint.reach + NEAR_REACH_M + cellM;
    for (let at = 0; at < width * height; at++) {
      const known = classes[at] as number;
      if (known === floorClasses.free || known === floorClasses.unknown) continue;
      const [i, j] = [left + (at % width), low + Math.floor(at / width)];
      const [dx, dy] = [(i + 0.5) * cellM - pose.x, (j + 0.5) * cellM - pose.y];
      if (dx * dx + dy * dy > reach * reach) continue;
      this.#hit(dx * cos + dy * sin, dy * cos - dx * sin, known, map.travelSince(i, j, nowMs, travel));
    }
  }

  #hit(x: number, y: number, known: number, since: number): void {
    const { distance } = this.#footprint.nearness(x, y, this.#near);
    // Deeper inside are parts of the robot itself.
    if (distance <= -OWN_BODY_M) return;
    const metres = Math.max(0, distance - this.#map.cellM / 2 - since);
    const half = this.#halfWidth(Math.hypot(x, y));
    const bearing = Math.atan2(y, x);
    const last = Math.round((bearing + half) / SECTOR);
    for (let n = Math.round((bearing - half) / SECTOR); n <= last; n++) {
      const sector = sectorOf(n);
      if (metres >= (this.#hitM[sector] as number)) continue;
      this.#hitM[sector] = metres;
      this.#isDrop[sector] = known === floorClasses.dropOff ? 1 : 0;
    }
  }

  /** Marks the lengths and sectors of all unseen floor. One loop without calls: there may be thousands of cells. */
  #findUnseen(pose: Readonly<FloorPose>): void {
    const { cellM } = this.#map;
    const { classes, cells } = this.#around;
    const { left, low, width, height } = cells;
    this.#distances ??= this.#table();
    const [distances, unseen] = [this.#distances, this.#unseen];
    unseen.fill(0);
    const [cos, sin] = [Math.cos(pose.yaw), Math.sin(pose.yaw)];
    const [rings, side, reach] = [this.#rings, this.#tableSide, this.#unseenReach];
    const middle = side >> 1;
    for (let row = 0; row < height; row++) {
      const dy = (low + row + 0.5) * cellM - pose.y;
      for (let column = 0; column < width; column++) {
        if (classes[row * width + column] !== floorClasses.unknown) continue;
        const dx = (left + column + 0.5) * cellM - pose.x;
        const squared = dx * dx + dy * dy;
        if (squared >= reach * reach) continue;
        const x = dx * cos + dy * sin;
        const y = dy * cos - dx * sin;
        const entry = (middle + Math.round(y / TABLE_M)) * side + middle + Math.round(x / TABLE_M);
        const distance = distances[entry] as number;
        // The robot stands there.
        if (distance <= Math.SQRT1_2 * cellM) continue;
        const first = Math.floor(distance / cellM - 0.5);
        const until = Math.min(Math.floor(distance / cellM + 0.5), rings - 1);
        const half = this.#halfWidth(Math.sqrt(squared));
        const bearing = Math.atan2(y, x);
        const last = Math.round((bearing + half) / SECTOR);
        for (let n = Math.round((bearing - half) / SECTOR); n <= last; n++) {
          const of = sectorOf(n) * rings;
          for (let ring = first; ring <= until; ring++) unseen[of + ring] = 1;
        }
      }
    }
  }

  /** The nearest unseen stretch of a sector. */
  #stretch(sector: number): NearSector['unseen'] {
    const { cellM } = this.#map;
    const rings = this.#unseen.subarray(sector * this.#rings, (sector + 1) * this.#rings);
    const from = rings.indexOf(1);
    if (from < 0) return null;
    let last = from;
    for (let i = from; i < rings.length && (i - last) * cellM <= SEEN_AGAIN_M; i++)
      if (rings[i] === 1) last = i;
    // Cells on which the robot stands in part were left out.
    return { fromM: from > 1 ? from * cellM : 0, toM: (last + 1) * cellM };
  }

  /** Half the angle that a cell takes, seen from base_link, radians. */
  #halfWidth(range: number): number {
    const { cellM } = this.#map;
    return range > cellM ? cellM / 2 / range : Math.PI - SECTOR;
  }

  #table(): Float32Array {
    const side = this.#tableSide;
    const middle = side >> 1;
    return Float32Array.from({ length: side * side }, (_, at) => {
      const [x, y] = [((at % side) - middle) * TABLE_M, (Math.floor(at / side) - middle) * TABLE_M];
      return this.#footprint.nearness(x, y, this.#near).distance;
    });
  }
}

/** Sectors are counted on around the circle. */
function sectorOf(n: number): number {
  return ((n % NEAR_SECTORS) + NEAR_SECTORS) % NEAR_SECTORS;
}
