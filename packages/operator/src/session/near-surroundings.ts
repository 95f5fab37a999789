import { type NearField, type NearSector, nearSectors } from '@farpoint/protocol';

/** What the robot has told last of what is near it. */
export class NearSurroundings {
  /** Counter-clockwise from straight ahead; empty before the first message. */
  sectors: readonly NearSector[] = [];
  #timeMs: number | null = null;
  #arrivedMs = 0;

  /**
   * Takes a message. The channel is unordered: one that was overtaken is ignored.
   *
   * @param nowMs when it arrived, `performance.now()`
   * @returns whether it is the newest
   */
  take(field: NearField, nowMs: number): boolean {
    if (this.#timeMs !== null && field.timeMs <= this.#timeMs) return false;
    this.#timeMs = field.timeMs;
    this.#arrivedMs = nowMs;
    this.sectors = nearSectors(field);
    return true;
  }

  /**
   * How long ago it was so, ms; `null` before the first message.
   *
   * @param nowMs `performance.now()`
   * @param offsetMs what the robot's clock is ahead of this one; `null` while unknown: then it counts from its arrival
   */
  ageMs(nowMs: number, offsetMs: number | null): number | null {
    if (this.#timeMs === null) return null;
    const sinceMs = offsetMs === null ? 0 : nowMs + offsetMs - this.#timeMs;
    return Math.max(nowMs - this.#arrivedMs, sinceMs);
  }
}
