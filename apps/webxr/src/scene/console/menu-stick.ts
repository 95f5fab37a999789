/** A stick that moves a mark from entry to entry: one for each push, however long it lasts. Pure. */

/**
 * A push begins at this deflection, and the next one only after the stick has come back to the second. Chosen: as for the steps
 * of a turn (operator-turn.ts), somewhat earlier; menu-stick.test.ts holds it.
 */
const PUSHED = 0.6;
const BACK = 0.3;

export class MenuStick {
  #pushed = true;

  /**
   * @param deflection backwards, −1…1; as WebXR has it, pushing forward is −1
   * @returns 1: down, −1: up, 0: stay
   */
  read(deflection: number): 1 | -1 | 0 {
    const size = Math.abs(deflection);
    if (this.#pushed) {
      if (size < BACK) this.#pushed = false;
      return 0;
    }
    if (size < PUSHED) return 0;
    this.#pushed = true;
    return deflection > 0 ? 1 : -1;
  }

  /** A stick that is deflected when the menu opens must come back first. */
  reset(): void {
    this.#pushed = true;
  }
}
