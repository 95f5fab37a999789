/** Readings of the robot's sensors and topics: the newest of each topic. */
import type { Reading } from '@farpoint/protocol';

/** A reading and its age. */
export interface AgedReading {
  /** As the robot sent it. */
  reading: Reading;
  /** Time since the robot took the reading, ms. */
  ageMs: number;
}

/** Maximum number of topics that are kept. */
const MOST_TOPICS = 64;

/** The newest reading of each topic of one robot. */
export class Readings {
  readonly #newest = new Map<string, { reading: Reading; readAtMs: number }>();

  /**
   * Takes a reading. The channel is unordered: a reading older than the known one is ignored.
   *
   * @param nowMs this browser's clock
   * @returns whether it is the newest of its topic
   */
  take(reading: Reading, nowMs: number): boolean {
    const readAtMs = nowMs - reading.ageMs;
    const before = this.#newest.get(reading.topic);
    if (before === undefined && this.#newest.size >= MOST_TOPICS) return false;
    // Delivery times vary: ages that differ by less than half a second say nothing about the order.
    if (before !== undefined && readAtMs < before.readAtMs - 500) return false;
    this.#newest.set(reading.topic, { reading, readAtMs });
    return true;
  }

  /**
   * The newest reading of each topic, in the order in which topics first appeared.
   *
   * @param nowMs this browser's clock
   */
  list(nowMs: number): AgedReading[] {
    return [...this.#newest.values()].map(({ reading, readAtMs }) => ({ reading, ageMs: nowMs - readAtMs }));
  }
}
