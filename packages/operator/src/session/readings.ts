/** Readings of the robot's sensors and topics: the newest few of each topic. */
import type { Reading } from '@farpoint/protocol';

/** A reading and its age. */
export interface AgedReading {
  /** As the robot sent it. */
  reading: Reading;
  /** Time since the robot took the reading, ms. */
  ageMs: number;
  /** Typical time between two readings of the topic, ms; `null` before two are known. */
  intervalMs: number | null;
}

interface Kept {
  reading: Reading;
  readAtMs: number;
}

/** Maximum number of topics that are kept. */
const MOST_TOPICS = 64;
/** Of each topic. The robot sends at most 5 readings a second: more than 3 s. */
const MOST_OF_TOPIC = 16;

/** The newest readings of each topic of one robot. */
export class Readings {
  /** Of each topic, the newest last. */
  readonly #kept = new Map<string, Kept[]>();

  /**
   * Takes a reading. The channel is unordered: a reading older than the known one is ignored.
   *
   * @param nowMs this browser's clock
   * @returns whether it is the newest of its topic
   */
  take(reading: Reading, nowMs: number): boolean {
    const readAtMs = nowMs - reading.ageMs;
    const kept = this.#kept.get(reading.topic) ?? [];
    const newest = kept.at(-1);
    if (newest === undefined && this.#kept.size >= MOST_TOPICS) return false;
    if (newest !== undefined && isOlder(reading, readAtMs, newest)) return false;
    // The robot repeats readings.
    if (newest !== undefined && reading.timeMs !== undefined && reading.timeMs === newest.reading.timeMs)
      kept.pop();
    kept.push({ reading, readAtMs });
    if (kept.length > MOST_OF_TOPIC) kept.shift();
    this.#kept.set(reading.topic, kept);
    return true;
  }

  /**
   * One reading of each topic, in the order in which topics first appeared.
   *
   * @param nowMs this browser's clock
   * @param instantMs of each topic, the newest reading that the robot had at this time of its clock, or its oldest that
   * is kept; by default, the newest
   */
  list(nowMs: number, instantMs: number = Number.POSITIVE_INFINITY): AgedReading[] {
    return [...this.#kept.values()].flatMap((kept) => {
      const there = kept.findLast(({ reading }) => (reading.timeMs ?? 0) <= instantMs) ?? kept[0];
      if (there === undefined) return [];
      const { reading, readAtMs } = there;
      return [{ reading, ageMs: nowMs - readAtMs, intervalMs: intervalOf(kept) }];
    });
  }
}

function intervalOf(kept: readonly Kept[]): number | null {
  const times = kept.flatMap(({ reading: { timeMs } }) => (timeMs === undefined ? [] : [timeMs]));
  const intervals = times.slice(1).map((timeMs, i) => timeMs - (times[i] as number));
  return intervals.sort((a, b) => a - b)[intervals.length >> 1] ?? null;
}

function isOlder(reading: Reading, readAtMs: number, newest: Kept): boolean {
  const { timeMs } = newest.reading;
  if (reading.timeMs !== undefined && timeMs !== undefined) return reading.timeMs < timeMs;
  // Delivery times vary: ages that differ by less than half a second say nothing about the order.
  return readAtMs < newest.readAtMs - 500;
}
