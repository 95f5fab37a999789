/** Which of the connected gamepads drives, and which look like one and cannot. */

/** The fields of a Gamepad that are read. */
export interface ConnectedPad {
  readonly id: string;
  readonly mapping: string;
  readonly buttons: readonly { readonly pressed: boolean }[];
}

/**
 * Takes the first gamepad whose buttons have known places. Of others nobody knows which button is which: guessing would
 * drive the robot by the wrong one.
 */
export class PickGamepad {
  /** Names that people have been told. */
  readonly #told = new Set<string>();

  /**
   * @param pads as `navigator.getGamepads()` gives them
   * @param onUnknown told once of each other gamepad that somebody uses, while there is none that drives
   */
  pick<Pad extends ConnectedPad>(
    pads: readonly (Pad | null)[],
    onUnknown: (name: string) => void,
  ): Pad | null {
    const known = pads.find((pad) => pad?.mapping === 'standard');
    if (known !== undefined) return known;
    for (const pad of pads) {
      if (pad === null || this.#told.has(pad.id) || !pad.buttons.some(({ pressed }) => pressed)) continue;
      this.#told.add(pad.id);
      onUnknown(pad.id);
    }
    return null;
  }
}

/** The name of a gamepad as people know it; empty if it has none. @param id as browsers give it */
export function gamepadName(id: string): string {
  // Browsers add numbers of the maker and the product.
  return id
    .replace(/\s*\(.*$/, '')
    .slice(0, 40)
    .trim();
}
