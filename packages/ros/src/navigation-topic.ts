/** A navigator's topic: paths or maps, placed in the robot's world as far as it is known where their frames are. */
import { type Pose, READING_LIMITS } from '@farpoint/protocol';
import type { NavigationNews, NavigationRefusal } from './navigation-news.ts';
import { type FramedMap, placeMap, readMap } from './occupancy-map.ts';
import { type FramedPath, placePath, readPath } from './planned-path.ts';
import { shortened, type TopicReading } from './reading.ts';
import type { TopicEntry } from './topic-table.ts';

/** Pose of a frame in the world at the time of a stamp, ns (0: now); `null` if it is not known. */
export type FramePose = (frameId: string, stampNs: bigint) => Pose | null;

const LABELS = { path: 'Path', map: 'Map' } as const;
const MOST_FRAME = 20;

interface Unplaced {
  at: FramedPath | FramedMap;
  place: (framePose: Pose | null) => NavigationNews;
}

export class NavigationTopic {
  readonly #entry: TopicEntry;
  readonly #kind: 'path' | 'map';
  /** What waits for its frame to become known. */
  #waiting: Unplaced | null = null;

  constructor(entry: TopicEntry) {
    this.#entry = entry;
    this.#kind = entry.as === 'map' ? 'map' : 'path';
  }

  static is({ as }: TopicEntry): boolean {
    return as === 'path' || as === 'map';
  }

  /** Whether something waits for its frame to become known. */
  get waits(): boolean {
    return this.#waiting !== null;
  }

  /** @throws {Error} if the message does not match the topic's type */
  take(message: unknown, framePose: FramePose): TopicReading {
    if (this.#kind === 'map') {
      const map = readMap(message);
      return this.#place({ at: map, place: (pose) => placeMap(map, pose) }, framePose);
    }
    const path = readPath(message);
    return this.#place({ at: path, place: (pose) => placePath(path, pose) }, framePose);
  }

  /** Call it when frames have moved. @returns `null` unless the frame of what waited is known now */
  retry(framePose: FramePose): TopicReading | null {
    if (this.#waiting === null) return null;
    // At the time of its stamp the frame may still have been unknown.
    const reading = this.#place(this.#waiting, (frameId) => framePose(frameId, 0n));
    return this.waits ? null : reading;
  }

  #place(unplaced: Unplaced, framePose: FramePose): TopicReading {
    const { at, place } = unplaced;
    const news = place(framePose(at.frameId, at.stampNs));
    this.#waiting = news.kind === 'refused' && news.reason === 'unknown-frame' ? unplaced : null;
    const { topic, label } = this.#entry;
    return {
      topic,
      label: shortened(label ?? LABELS[this.#kind], READING_LIMITS.label),
      level: news.kind === 'refused' ? 'warn' : 'ok',
      values: [['', wordsOf(news)]],
      navigation: news,
    };
  }
}

function wordsOf(news: NavigationNews): string {
  if (news.kind === 'refused') return `not shown: ${refusalWords(news.reason, news.frame)}`;
  if (news.kind === 'map') {
    const { width, height, cellM } = news.map;
    return `${(width * cellM).toFixed(1)} × ${(height * cellM).toFixed(1)} m, cells of ${Number(cellM.toFixed(3))} m`;
  }
  return news.points.length === 0 ? 'none' : `${lengthOf(news.points).toFixed(1)} m`;
}

function refusalWords(reason: NavigationRefusal, frame: string): string {
  const name = shortened(frame, MOST_FRAME);
  if (reason === 'unknown-frame') return `where ${name === '' ? 'its frame' : name} is, is unknown`;
  return reason === 'not-level' ? `${name} is not level` : `${name} is out of range`;
}

function lengthOf(points: readonly [number, number][]): number {
  let sum = 0;
  points.forEach(([x, y], i) => {
    const before = points[i - 1];
    if (before !== undefined) sum += Math.hypot(x - before[0], y - before[1]);
  });
  return sum;
}
