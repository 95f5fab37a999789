/**
 * The navigator's newest path and map, and what of them each operator is told next. A map is told tile by tile: first all
 * that an operator does not know, then in turn, slowly, because a message may be lost.
 */
import { type MapTiles, type PlannedPath, tileCount, tileRuns } from '@farpoint/protocol';
import type { NavigationNews, OccupancyMap } from '@farpoint/ros';

/** A path without news is told again after this long, ms; to a narrow path of the network, after the second. */
const REPEAT_PATH_MS = { wide: 1000, narrow: 2000 };
/**
 * A path that is older than this is shown nowhere: its age is told, and less often, ms. Chosen: twice the 5 s
 * for which the page draws it (navigation-view.ts).
 */
const OLD_PATH_MS = 10_000;
const REPEAT_OLD_PATH_MS = 5000;
/** Then nothing is said about it any more, ms. As long as the page speaks of it (navigation-view.ts). */
const GONE_PATH_MS = 60_000;
/** Time between two messages of tiles: of those that are news, and of those that are repeated, ms. */
const TILES_MS = { wide: 100, narrow: 400 };
const REPEAT_TILES_MS = { wide: 1000, narrow: 4000 };
/** Characters of runs in a message: a message is at most 4096 bytes long, and one tile takes at most 1368. */
const MESSAGE_RUNS = 1500;
/** Tiles in a message. */
const MESSAGE_TILES = 64;
/** A tile's position and punctuation. */
const TILE_OVERHEAD = 10;

/** How much an operator's path of the network carries. */
export type PathWidth = 'wide' | 'narrow';

interface KeptMap extends Omit<OccupancyMap, 'cells'> {
  topic: string;
  number: number;
  timeMs: number;
  /** Of each tile. */
  runs: string[];
  /** Counts the changes of each tile, from 1. */
  versions: Uint32Array;
}

/** What an operator has been told. */
interface Told {
  pathMs: number;
  pathTimeMs: number;
  mapNumber: number;
  tilesMs: number;
  /** Version of each tile; 0: none. */
  versions: Uint32Array;
  /** The tile to go on with. */
  next: number;
}

export class NavigationBoard {
  #path: Pick<PlannedPath, 'topic' | 'timeMs' | 'points'> | null = null;
  #map: KeptMap | null = null;
  #maps = 0;
  readonly #told = new WeakMap<object, Told>();

  take(topic: string, news: NavigationNews, nowMs: number): void {
    if (news.kind === 'map') this.#takeMap(topic, news.map, nowMs);
    else if (news.kind === 'path') this.#path = { topic, timeMs: nowMs, points: news.points };
    else if (news.of === 'map') this.#map = null;
    // Whoever was shown the path before it must not go on to see it.
    else this.#path = this.#path === null ? null : { topic, timeMs: nowMs, points: [] };
  }

  /** What to tell this operator now: at most a path and some tiles. Call it for each message of the robot's state. */
  next(operator: object, width: PathWidth, nowMs: number): (PlannedPath | MapTiles)[] {
    const told = this.#told.get(operator) ?? noneTold();
    this.#told.set(operator, told);
    return [this.#nextPath(told, width, nowMs), this.#nextTiles(told, width, nowMs)].filter(
      (message) => message !== null,
    );
  }

  #nextPath(told: Told, width: PathWidth, nowMs: number): PlannedPath | null {
    if (this.#path === null) return null;
    const { topic, timeMs, points } = this.#path;
    const ageMs = Math.max(0, nowMs - timeMs);
    if (ageMs > GONE_PATH_MS) return null;
    const repeatMs = ageMs > OLD_PATH_MS ? REPEAT_OLD_PATH_MS : REPEAT_PATH_MS[width];
    if (timeMs === told.pathTimeMs && nowMs - told.pathMs < repeatMs) return null;
    Object.assign(told, { pathMs: nowMs, pathTimeMs: timeMs });
    return { type: 'path', topic, timeMs, ageMs, points };
  }

  #nextTiles(told: Told, width: PathWidth, nowMs: number): MapTiles | null {
    const map = this.#map;
    if (map === null || nowMs - told.tilesMs < TILES_MS[width]) return null;
    if (told.mapNumber !== map.number)
      Object.assign(told, { mapNumber: map.number, versions: new Uint32Array(map.runs.length), next: 0 });
    const isNews = told.versions.some((version, i) => version !== map.versions[i]);
    if (!isNews && nowMs - told.tilesMs < REPEAT_TILES_MS[width]) return null;
    told.tilesMs = nowMs;
    const { runs, versions, ...facts } = map;
    const ageMs = Math.max(0, nowMs - map.timeMs);
    return { type: 'map', ...facts, ageMs, tiles: nextTiles(map, told, isNews) };
  }

  #takeMap(topic: string, { cells, ...place }: OccupancyMap, nowMs: number): void {
    const runs = Array.from({ length: tileCount(place) }, (_, index) => tileRuns(place, index, cells));
    const before = this.#map;
    if (before !== null && before.topic === topic && isSamePlace(before, place)) {
      runs.forEach((text, i) => {
        if (text !== before.runs[i]) before.versions[i] = (before.versions[i] as number) + 1;
      });
      Object.assign(before, { runs, timeMs: nowMs });
      return;
    }
    this.#maps = (this.#maps + 1) >>> 0;
    const versions = new Uint32Array(runs.length).fill(1);
    this.#map = { topic, number: this.#maps, timeMs: nowMs, ...place, runs, versions };
  }
}

/** Goes through the tiles in turn; @param isNews leaves out those that the operator knows */
function nextTiles({ runs, versions }: KeptMap, told: Told, isNews: boolean): MapTiles['tiles'] {
  const tiles: MapTiles['tiles'] = [];
  let characters = 0;
  for (let passed = 0; passed < runs.length; passed++) {
    const index = told.next;
    if (!isNews || told.versions[index] !== versions[index]) {
      const text = runs[index] as string;
      characters += text.length + TILE_OVERHEAD;
      if (tiles.length > 0 && (characters > MESSAGE_RUNS || tiles.length >= MESSAGE_TILES)) break;
      tiles.push([index, text]);
      told.versions[index] = versions[index] as number;
    }
    told.next = (index + 1) % runs.length;
  }
  return tiles;
}

function isSamePlace(a: Omit<OccupancyMap, 'cells'>, b: Omit<OccupancyMap, 'cells'>): boolean {
  const isSame = a.width === b.width && a.height === b.height && a.cellM === b.cellM;
  return isSame && a.origin.x === b.origin.x && a.origin.y === b.origin.y && a.origin.yaw === b.origin.yaw;
}

function noneTold(): Told {
  const never = Number.NEGATIVE_INFINITY;
  return {
    pathMs: never,
    pathTimeMs: -1,
    mapNumber: -1,
    tilesMs: never,
    versions: new Uint32Array(),
    next: 0,
  };
}
