/** Finds an operator who asks for motion without holding the grip. Pure: time is an argument. */
import type { DriveInput } from './drive-input.ts';

/**
 * A stick that is pushed for this long without a grip is told of, ms. Chosen: a hand that pushes just before it grips
 * needs no telling, and one that waits for the robot to move begins to wonder; missing-grip.test.ts holds it.
 */
const LATE_GRIP_MS = 400;

/** Tells of each push without a grip once. */
export class MissingGrip {
  /** When each push without a grip began; infinite once it has been told. */
  readonly #sinceMs = new Map<DriveInput, number>();

  /**
   * Takes note of every device's state. Call it as often as commands are sent.
   *
   * @returns the device that is pushed while its grip is open, once for each push; `null` if there is none
   */
  update(inputs: readonly DriveInput[], nowMs: number): DriveInput | null {
    let found: DriveInput | null = null;
    for (const input of inputs) {
      const sinceMs = this.#sinceMs.get(input);
      if (input.held || !isPushed(input)) this.#sinceMs.delete(input);
      else if (sinceMs === undefined) this.#sinceMs.set(input, nowMs);
      else if (nowMs - sinceMs >= LATE_GRIP_MS) {
        this.#sinceMs.set(input, Number.POSITIVE_INFINITY);
        found ??= input;
      }
    }
    return found;
  }
}

function isPushed({ wish, pushed }: DriveInput): boolean {
  return pushed ?? (wish.forward !== 0 || wish.left !== 0);
}
