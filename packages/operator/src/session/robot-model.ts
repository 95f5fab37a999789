import type { JointPositions, ModelLink, ModelShape, RobotModelParts } from '@farpoint/protocol';

/** The robot's model, as the robot has told it, and where its joints are. */
export class RobotModel {
  /** The links that move, from link 1 on; link 0, the base, is base_link. Empty until the whole model is known. */
  links: readonly ModelLink[] = [];
  /** What is drawn of the links; empty until the whole model is known, and if there is none. */
  shapes: readonly ModelShape[] = [];
  /** Counts the changes of the model. */
  changes = 0;
  /** Of the moving links, in their order: radians or metres from where the model has them. */
  positions: readonly number[] = [];
  #number: number | null = null;
  #coming: { links: ModelLink[]; shapes: ModelShape[]; count: number } | null = null;
  #jointsMs: number | null = null;
  #receivedMs = 0;

  /**
   * Takes parts of the model. Parts that do not follow those before, or refer to links that were not told, end it: the
   * model stays as it was.
   *
   * @returns whether the whole model is known now
   */
  takeParts({ number, count, at, parts }: RobotModelParts): boolean {
    if (at === 0) this.#coming = { links: [], shapes: [], count };
    const coming = this.#coming;
    if (coming === null) return false;
    const { links, shapes } = coming;
    const follows = links.length + shapes.length === at && coming.count === count;
    const fits = parts.every((part) => {
      if (part.part === 'shape') {
        shapes.push(part);
        return part.link <= links.length;
      }
      links.push(part);
      return part.parent < links.length && shapes.length === 0;
    });
    if (!follows || !fits) {
      this.#coming = null;
      return false;
    }
    if (at + parts.length < count) return false;
    this.#coming = null;
    this.#number = number;
    this.links = links;
    this.shapes = shapes;
    this.positions = links.map(() => 0);
    this.#jointsMs = null;
    this.changes++;
    return true;
  }

  /**
   * Takes where the joints are. The channel is unordered: a message that was overtaken, or belongs to another model, is
   * ignored.
   *
   * @param nowMs when it arrived, `performance.now()`
   * @returns whether it is newer than what was known
   */
  takeJoints({ model, timeMs, ageMs, positions }: JointPositions, nowMs: number): boolean {
    if (model !== this.#number || positions.length !== this.links.length) return false;
    if (this.#jointsMs !== null && timeMs < this.#jointsMs) return false;
    this.#jointsMs = timeMs;
    this.#receivedMs = nowMs - ageMs;
    this.positions = positions;
    return true;
  }

  /** How long ago the robot heard where its joints are, ms; `null` if it has not. @param nowMs `performance.now()` */
  jointsAgeMs(nowMs: number): number | null {
    return this.#jointsMs === null ? null : Math.max(0, nowMs - this.#receivedMs);
  }
}
