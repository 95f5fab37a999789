/** Things that are done only when they are asked for twice, soon after one another. Time is an argument. */

/** The second press counts so long after the first, ms. Chosen: long enough to read what the button says now; press-twice.test.ts holds it. */
const CONFIRM_MS = 3000;
/** A double click is one press, ms. Chosen: as systems have it; press-twice.test.ts holds it. */
const BOUNCE_MS = 300;

export class PressTwice {
  #armed: { readonly id: string; readonly atMs: number } | null = null;

  /** What the next press confirms; `null`: nothing. */
  armed(nowMs: number): string | null {
    const armed = this.#armed;
    return armed !== null && nowMs - armed.atMs < CONFIRM_MS ? armed.id : null;
  }

  /** A press of this. @returns whether it is to be done: it was pressed before, and nothing else since */
  press(id: string, nowMs: number): boolean {
    const isSecond = this.armed(nowMs) === id;
    if (isSecond && nowMs - (this.#armed?.atMs ?? 0) < BOUNCE_MS) return false;
    this.#armed = isSecond ? null : { id, atMs: nowMs };
    return isSecond;
  }

  /** Something else was pressed, or it can no longer be done. */
  forget(): void {
    this.#armed = null;
  }
}
