/** How the emergency stop came to be latched, for people. */
import type { EstopCause, EstopStart } from '@farpoint/protocol';
import { plainName } from '../../admit/access/plain-name.ts';

/** Remembers who pressed STOP first, also after that operator has left, and whether the robot started latched. */
export class EstopStory {
  #pressedBy: string | null = null;
  #start: EstopStart | null;

  /** @param start why the robot started latched; `null` if it did not */
  constructor(start: EstopStart | null) {
    this.#start = start;
  }

  /** It was latched, latched again or released. @param by the operator's name; undefined: it was no operator */
  changed(latched: boolean, by?: string): void {
    if (!latched) [this.#pressedBy, this.#start] = [null, null];
    else if (by !== undefined) this.#pressedBy ??= plainName(by);
  }

  /** What it adds to the guard's own account. */
  get told(): Pick<EstopCause, 'pressedBy' | 'start'> {
    return {
      ...(this.#pressedBy === null ? {} : { pressedBy: this.#pressedBy }),
      ...(this.#start === null ? {} : { start: this.#start }),
    };
  }
}
