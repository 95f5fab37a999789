import { NEAR_REACH_M, NEAR_SECTORS, NEAR_UNSEEN_M, type NearSector } from '@farpoint/protocol';
import type { FloorMap } from './floor-map.ts';
import type { Footprint, Nearness } from './footprint.ts';
import { OWN_BODY_M } from './obstacle-guard-options.ts';
import { type FloorPose, floorClasses } from './sensor-grid.ts';

const SECTOR = (2 * Math.PI) / NEAR_SECTORS;
/** An unseen stretch ends where the floor is seen again for so long, metres: shorter ones are gaps in what is seen. */
const SEEN_AGAIN_M = 0.2;

/** Of the table of distances, metres. */
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

  constructor(map: FloorMap, footprint: Footprint) {
    this.#map = map;
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
    const map = this.#map;
    const { cellM } = map;
    this.#hitM.fill(Number.POSITIVE_INFINITY);
    this.#unseen.fill(0);
    this.#distances ??= this.#table();
    const [cos, sin] = [Math.cos(pose.yaw), Math.sin(pose.yaw)];
    const reach = this.#footprint.reach + NEAR_REACH_M + cellM;
    const [left, right] = [map.cellOf(pose.x - reach), map.cellOf(pose.x + reach)];
    for (let j = map.cellOf(pose.y - reach); j <= map.cellOf(pose.y + reach); j++) {
      const dy = (j + 0.5) * cellM - pose.y;
      for (let i = left; i <= right; i++) {
        const dx = (i + 0.5) * cellM - pose.x;
        const squared = dx * dx + dy * dy;
        if (squared > reach * reach) continue;
        const known = map.classAt(i, j, nowMs, travel);
        if (known === floorClasses.free) continue;
        const [x, y] = [dx * cos + dy * sin, dy * cos - dx * sin];
        if (known !== floorClasses.unknown) this.#hit(x, y, known, map.travelSince(i, j, nowMs, travel));
        else if (squared < this.#unseenReach * this.#unseenReach) this.#markUnseen(x, y, Math.sqrt(squared));
      }
    }
    return Array.from({ length: NEAR_SECTORS }, (_, i) => {
      const hit = this.#hitM[i] as number;
      const kind = this.#isDrop[i] === 1 ? 'drop' : 'thing';
      return {
        hit: hit <= NEAR_REACH_M ? { kind, metres: hit } : null,
        unseen: this.#stretch(i),
      };
    });
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

  #markUnseen(x: number, y: number, range: number): void {
    const { cellM } = this.#map;
    const middle = this.#tableSide >> 1;
    const row = middle + Math.round(y / TABLE_M);
    const distance = this.#distances?.[row * this.#tableSide + middle + Math.round(x / TABLE_M)] ?? 0;
    // The robot stands there.
    if (distance <= Math.SQRT1_2 * cellM) return;
    const first = Math.floor(distance / cellM - 0.5);
    const until = Math.min(Math.floor(distance / cellM + 0.5), this.#rings - 1);
    const half = this.#halfWidth(range);
    const bearing = Math.atan2(y, x);
    const last = Math.round((bearing + half) / SECTOR);
    for (let n = Math.round((bearing - half) / SECTOR); n <= last; n++) {
      const at = sectorOf(n) * this.#rings;
      for (let ring = first; ring <= until; ring++) this.#unseen[at + ring] = 1;
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
