/** Notices that an operator asks for motion without holding the grip. Pure: time is an argument. */
import type { DriveInput } from './drive-input.ts';

/** A hand that pushes the stick just before it grips needs no telling, ms. */
const LATE_GRIP_MS = 400;

/** Whose robot does not move wonders why: it is told once for each push. */
export class MissingGrip {
  /** When each push without a grip began; infinite once it has been told. */
  readonly #sinceMs = new Map<DriveInput, number>();

  /**
   * Call it at each tick.
   *
   * @returns the device whose stick or keys are pushed while its grip is open, once for each push; `null` if there is none
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
