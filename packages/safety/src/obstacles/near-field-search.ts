import { NEAR_REACH_M, NEAR_SECTORS, NEAR_UNSEEN_M, type NearSector } from '@farpoint/protocol';
import type { FloorMap } from './floor-map.ts';
import type { Footprint, Nearness } from './footprint.ts';
import { OWN_BODY_M } from './obstacle-guard-options.ts';
import { type FloorPose, floorClasses } from './sensor-grid.ts';

const SECTOR = (2 * Math.PI) / NEAR_SECTORS;
/** An unseen stretch ends where the floor is seen again for so long, metres: shorter ones are gaps in what is seen. */
const SEEN_AGAIN_M = 0.2;

/** Finds what is nearest to a footprint in each direction. Keeps its buffers: one per guard. */
export class NearFieldSearch {
  readonly #map: FloorMap;
  readonly #footprint: Footprint;
  /** Cells around base_link, the nearest first: i, j of each. */
  readonly #around: Int16Array;
  readonly #near: Nearness = { distance: 0, x: 0, y: 0 };
  readonly #hitM = new Float64Array(NEAR_SECTORS);
  readonly #isDrop = new Uint8Array(NEAR_SECTORS);
  /** Of each sector and each cell's length of distance: whether some floor there is unseen. */
  readonly #unseen: Uint8Array;
  /** How many lengths there are. */
  readonly #rings: number;

  constructor(map: FloorMap, footprint: Footprint) {
    this.#map = map;
    this.#footprint = footprint;
    this.#rings = Math.ceil(NEAR_UNSEEN_M / map.cellM);
    this.#unseen = new Uint8Array(NEAR_SECTORS * this.#rings);
    const most = Math.ceil((footprint.reach + NEAR_REACH_M) / map.cellM) + 1;
    const cells: [number, number][] = [];
    for (let j = -most; j <= most; j++)
      for (let i = -most; i <= most; i++) if (i * i + j * j <= most * most) cells.push([i, j]);
    cells.sort(([a, b], [c, d]) => a * a + b * b - (c * c + d * d));
    this.#around = Int16Array.from(cells.flat());
  }

  /**
   * Looks around.
   *
   * @param travel how far the robot has gone, metres: only counts without odometry
   * @returns of each sector, by the protocol's numbers
   */
  look(pose: Readonly<FloorPose>, nowMs: number, travel: number): NearSector[] {
    const [map, hitM] = [this.#map, this.#hitM];
    const { cellM } = map;
    hitM.fill(Number.POSITIVE_INFINITY);
    this.#unseen.fill(0);
    const [cos, sin] = [Math.cos(pose.yaw), Math.sin(pose.yaw)];
    const [middleI, middleJ] = [map.cellOf(pose.x), map.cellOf(pose.y)];
    const around = this.#around;
    for (let k = 0; k < around.length; k += 2) {
      const [i, j] = [middleI + (around[k] as number), middleJ + (around[k + 1] as number)];
      const known = map.classAt(i, j, nowMs, travel);
      if (known === floorClasses.free) continue;
      const [dx, dy] = [(i + 0.5) * cellM - pose.x, (j + 0.5) * cellM - pose.y];
      const [x, y] = [dx * cos + dy * sin, dy * cos - dx * sin];
      if (known === floorClasses.unknown) this.#markUnseen(x, y);
      else this.#hit(x, y, known, map.travelSince(i, j, nowMs, travel));
    }
    return Array.from({ length: NEAR_SECTORS }, (_, i) => {
      const hit = hitM[i] as number;
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
    const drop = known === floorClasses.dropOff ? 1 : 0;
    this.#each(x, y, (sector) => {
      if (metres >= (this.#hitM[sector] as number)) return;
      this.#hitM[sector] = metres;
      this.#isDrop[sector] = drop;
    });
  }

  #markUnseen(x: number, y: number): void {
    const { cellM } = this.#map;
    const range = Math.hypot(x, y);
    if (range - this.#footprint.reach > NEAR_UNSEEN_M + cellM) return;
    const { distance } = this.#footprint.nearness(x, y, this.#near);
    // The robot stands there.
    if (distance <= Math.SQRT1_2 * cellM) return;
    const first = Math.floor(distance / cellM - 0.5);
    const last = Math.min(Math.floor(distance / cellM + 0.5), this.#rings - 1);
    this.#each(x, y, (sector) => {
      for (let ring = first; ring <= last; ring++) this.#unseen[sector * this.#rings + ring] = 1;
    });
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

  /** Visits each sector into which a cell reaches. */
  #each(x: number, y: number, visit: (sector: number) => void): void {
    const { cellM } = this.#map;
    const range = Math.hypot(x, y);
    const half = range > cellM ? cellM / 2 / range : Math.PI;
    const bearing = Math.atan2(y, x);
    const last = Math.round((bearing + half) / SECTOR);
    const first = Math.round((bearing - half) / SECTOR);
    for (let n = first; n <= last && n < first + NEAR_SECTORS; n++)
      visit(((n % NEAR_SECTORS) + NEAR_SECTORS) % NEAR_SECTORS);
  }
}
