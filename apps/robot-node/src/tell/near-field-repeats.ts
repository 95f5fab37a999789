import type { NearField } from '@farpoint/protocol';

/** What has not changed is repeated this often, so that operators know that it is still so, ms. */
const REPEAT_MS = 500;

/** Leaves out what operators already know. */
export class NearFieldRepeats {
  #told = '';
  #toldMs = Number.NEGATIVE_INFINITY;

  /** @returns what is to be sent now; `null` if nothing */
  next(near: NearField | null, nowMs: number): NearField | null {
    if (near === null) return null;
    if (near.sectors === this.#told && nowMs - this.#toldMs < REPEAT_MS) return null;
    this.#told = near.sectors;
    this.#toldMs = nowMs;
    return near;
  }
}
