/** A stick that moves a mark from row to row: one row for each push, however long it lasts. Pure. */
const PUSHED = 0.6;
const RELEASED = 0.3;

export class MenuStick {
  #pushed = true;

  /**
   * @param deflection backwards, −1…1; as WebXR has it, pushing forward is −1
   * @returns 1: down, −1: up, 0: stay
   */
  read(deflection: number): 1 | -1 | 0 {
    const size = Math.abs(deflection);
    if (this.#pushed) {
      if (size < RELEASED) this.#pushed = false;
      return 0;
    }
    if (size < PUSHED) return 0;
    this.#pushed = true;
    return deflection > 0 ? 1 : -1;
  }

  /** A stick that is deflected when the menu opens must be let go first: it was driving. */
  reset(): void {
    this.#pushed = true;
  }
}
