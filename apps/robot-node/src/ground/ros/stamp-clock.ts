/**
 * When ROS messages were captured, by their stamps: on the robot's clock. A stamp that is old is old, however old; one that
 * lies ahead of the robot's time of day is refused. Only stamps that lie more than a day back are taken for another clock's,
 * a simulation's or one that was never set: what is later than the earliest of the last seconds is late by that much.
 */
import { FOREIGN_AGE_MS, type RosClock, readBoth } from './capture-time.ts';

/**
 * By so much clocks that are kept in step may differ, ms. Chosen: chrony and NTP keep it by far; at full
 * speed it costs 100 ms of way (docs/safety.md).
 */
export const MOST_AHEAD_MS = 100;
/**
 * Nobody knows when a cloud was captured whose stamp is refused. It counts as so old, ms: too old to be driven by, but what
 * stands in the robot's way is better seen late than not at all.
 */
export const REFUSED_AGE_MS = 1000;
/**
 * Localisation says ahead of time where frames will be, ms. Chosen: more than Nav2's AMCL does by default
 * (`transform_tolerance`, 1 s).
 */
const MOST_AHEAD_LOCALISED_MS = 2000;
/**
 * How long another clock is watched before its stamps are believed, ms. Chosen: ten clouds of a LiDAR;
 * meanwhile the source is silent, so that the robot waits.
 */
const SETTLES_MS = 1000;
/**
 * The least delay of the last one to two of these counts, ms. Chosen: clocks that drift by 100 ppm part by 2
 * ms in it; a delay that lasts longer is not noticed.
 */
const WINDOW_MS = 10_000;
/**
 * A source's stamps may go back by less, where messages overtake each other, ms. Chosen: as much as a message
 * may be late.
 */
const RESTART_MS = 1000;
/** Sources whose order is kept. */
const MOST_SOURCES = 2048;

/** Why a stamp is refused, for people; completes "its stamps …" or stands alone. */
export const stampRefusals = {
  ahead: 'its stamps are ahead of this machine’s time of day: keep both clocks in step (chrony, PTP)',
  missing: 'a message without a stamp after others that had one',
  repeated: 'a message that is not newer than the one before',
  unsettled: 'its stamps are of another clock, which is not known yet',
} as const;
export type StampRefusal = keyof typeof stampRefusals;

/** The stamps of one graph. */
export class StampClock {
  readonly #clock: RosClock;
  readonly #lastNs = new Map<string, bigint>();
  /** Of the other clock: the shortest from stamp to arrival in the present window and in the one before, ms. */
  #least = Number.POSITIVE_INFINITY;
  #leastBefore = Number.POSITIVE_INFINITY;
  #windowMs = Number.NEGATIVE_INFINITY;
  #settledMs = Number.POSITIVE_INFINITY;

  constructor(clock: RosClock) {
    this.#clock = clock;
  }

  /**
   * When a message was captured, robot's clock, ms; it is never after it was received.
   *
   * @param source of which this message must be newer than the last
   * @param receivedMs the robot's clock
   */
  inOrder(source: string, stampNs: bigint, receivedMs: number): number | StampRefusal {
    const lastNs = this.#lastNs.get(source);
    if (stampNs !== 0n && lastNs !== undefined) {
      const backMs = Number(lastNs - stampNs) / 1e6;
      if (backMs >= 0 && backMs <= RESTART_MS) return 'repeated';
    }
    return this.#judged(source, stampNs, receivedMs, MOST_AHEAD_MS);
  }

  /** The same of a source whose messages may overtake each other. @param localised whether it may be ahead of time */
  inAnyOrder(source: string, stampNs: bigint, receivedMs: number, localised = false): number | StampRefusal {
    return this.#judged(source, stampNs, receivedMs, localised ? MOST_AHEAD_LOCALISED_MS : MOST_AHEAD_MS);
  }

  /** When what a transform says was so, ms on the robot's clock; else, in words, why its stamp is refused. */
  ofTransform(source: string, stampNs: bigint, receivedMs: number, localised?: boolean): number | string {
    const judged = this.inAnyOrder(source, stampNs, receivedMs, localised);
    return typeof judged === 'number' ? judged : stampRefusals[judged];
  }

  #judged(source: string, stampNs: bigint, receivedMs: number, mostAheadMs: number): number | StampRefusal {
    // Some drivers never stamp.
    if (stampNs === 0n) return this.#lastNs.has(source) ? 'missing' : receivedMs;
    const { nowMs, wallNs } = readBoth(this.#clock);
    const ageMs = Number(wallNs - stampNs) / 1e6;
    if (ageMs < -mostAheadMs) return 'ahead';
    if (this.#lastNs.has(source) || this.#lastNs.size < MOST_SOURCES) this.#lastNs.set(source, stampNs);
    if (ageMs < FOREIGN_AGE_MS) return Math.min(nowMs - ageMs, receivedMs);
    return this.#foreign(receivedMs - Number(stampNs) / 1e6, receivedMs);
  }

  #foreign(offsetMs: number, receivedMs: number): number | StampRefusal {
    if (receivedMs - this.#windowMs > 2 * WINDOW_MS) {
      this.#least = Number.POSITIVE_INFINITY;
      this.#leastBefore = Number.POSITIVE_INFINITY;
      this.#windowMs = receivedMs;
      this.#settledMs = receivedMs + SETTLES_MS;
    } else if (receivedMs - this.#windowMs > WINDOW_MS) {
      this.#leastBefore = this.#least;
      this.#least = Number.POSITIVE_INFINITY;
      this.#windowMs = receivedMs;
    }
    this.#least = Math.min(this.#least, offsetMs);
    if (receivedMs < this.#settledMs) return 'unsettled';
    return receivedMs - (offsetMs - Math.min(this.#least, this.#leastBefore));
  }
}
