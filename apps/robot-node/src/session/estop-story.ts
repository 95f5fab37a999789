/** How the emergency stop came to be latched, for people. */
import type { EstopCause } from '@farpoint/protocol';
import type { LatchedStart } from '../drive/estop-journal.ts';

/** Remembers who pressed STOP first, also after that operator has left, and whether the robot started latched. */
export class EstopStory {
  #pressedBy: string | null = null;
  #start: LatchedStart | null;

  /** @param start why the robot started latched; `null` if it did not */
  constructor(start: LatchedStart | null) {
    this.#start = start;
  }

  /** It was latched, latched again or released. @param by the operator's name; undefined: it was no operator */
  changed(latched: boolean, by?: string): void {
    // Half a surrogate pair would take six characters of the message.
    if (latched) this.#pressedBy ??= by?.toWellFormed() ?? null;
    else [this.#pressedBy, this.#start] = [null, null];
  }

  /** What it adds to the guard's own account. */
  get told(): Pick<EstopCause, 'pressedBy' | 'start'> {
    return {
      ...(this.#pressedBy === null ? {} : { pressedBy: this.#pressedBy }),
      ...(this.#start === null ? {} : { start: this.#start }),
    };
  }
}
