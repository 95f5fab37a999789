import type { PlannedPath } from '@farpoint/protocol';

/** The path that the robot's own navigator has planned last. */
export class NavigatorPath {
  /** In the world, metres, from the robot to the goal; empty if there is none, and before the robot has told one. */
  points: PlannedPath['points'] = [];
  /** The robot's topic that it comes from; `null` before the first message. */
  topic: string | null = null;
  #timeMs = 0;
  #plannedAtMs = 0;

  /**
   * Takes a message. The channel is unordered: one that was overtaken is ignored.
   *
   * @param nowMs when it arrived, `performance.now()`
   * @returns whether it is a newer path than the one known
   */
  take({ topic, timeMs, ageMs, points }: PlannedPath, nowMs: number): boolean {
    if (this.topic !== null && timeMs < this.#timeMs) return false;
    const isNewer = this.topic === null || timeMs > this.#timeMs;
    // Of the same path, the message that was the fastest says best how old it is.
    const plannedAtMs = isNewer ? nowMs - ageMs : Math.min(this.#plannedAtMs, nowMs - ageMs);
    this.#timeMs = timeMs;
    this.#plannedAtMs = plannedAtMs;
    if (isNewer) [this.topic, this.points] = [topic, points];
    return isNewer;
  }

  /** How long ago the robot received it, ms; `null` before the first message. @param nowMs `performance.now()` */
  ageMs(nowMs: number): number | null {
    return this.topic === null ? null : Math.max(0, nowMs - this.#plannedAtMs);
  }
}
