/** What the robot's sensors and topics say: the newest reading of each topic. */
import type { Reading } from '@farpoint/protocol';

/** A reading and its age. */
export interface AgedReading {
  /** As the robot sent it. */
  reading: Reading;
  /** Since the robot read it, ms. */
  ageMs: number;
}

/** A robot has no more topics for people. */
const MOST_TOPICS = 64;

/** The newest reading of each topic of one robot. */
export class Readings {
  readonly #newest = new Map<string, { reading: Reading; readAtMs: number }>();

  /**
   * Unordered: a reading that is older than the one known is left out.
   *
   * @param nowMs this browser's clock
   * @returns whether it is the newest of its topic
   */
  take(reading: Reading, nowMs: number): boolean {
    const readAtMs = nowMs - reading.ageMs;
    const before = this.#newest.get(reading.topic);
    if (before === undefined && this.#newest.size >= MOST_TOPICS) return false;
    // Delivery times differ: up to half a second says nothing about the order.
    if (before !== undefined && readAtMs < before.readAtMs - 500) return false;
    this.#newest.set(reading.topic, { reading, readAtMs });
    return true;
  }

  /**
   * The newest reading of each topic, in the order in which the topics came first.
   *
   * @param nowMs this browser's clock
   */
  list(nowMs: number): AgedReading[] {
    return [...this.#newest.values()].map(({ reading, readAtMs }) => ({ reading, ageMs: nowMs - readAtMs }));
  }
}
