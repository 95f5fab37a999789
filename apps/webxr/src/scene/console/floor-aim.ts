/**
 * When a hand in the headset points at the floor: the grip of the hand that does not drive is held to aim, and opened to point; or
 * the menu's entry is chosen, and then a trigger is pulled or a bare hand pinches. Pure: time is an argument.
 */

/** What points once it is opened or pulled; `null`: no hand aims. */
export type AimBy = 'grip' | 'trigger' | null;

/** A grip that is held for less aims at nothing, ms. Chosen: a hand that only closes; floor-aim.test.ts holds it. */
const AIMED_MS = 250;
/** After the menu's entry, a trigger points for so long, ms. Chosen: time to look round and aim; floor-aim.test.ts holds it. */
const ARMED_MS = 15_000;

export interface AimReading {
  /** The grip of the hand that does not drive; `away`: nobody knows. */
  readonly grip: 'held' | 'open' | 'away';
  /** Nothing is pointed at now: the menu is open, a hand holds the model, the headset is away, or nobody would see it. */
  readonly barred: boolean;
  /** A hand drives: the other hand's trigger speaks. */
  readonly drives: boolean;
}

export class FloorAim {
  #by: AimBy = null;
  #sinceMs = 0;
  /** A grip that was held already was not meant to aim. */
  #mustOpen = true;

  get by(): AimBy {
    return this.#by;
  }

  /** The next trigger or pinch points. */
  arm(nowMs: number): void {
    this.#by = 'trigger';
    this.#sinceMs = nowMs;
  }

  /** A trigger was pulled and let go, or a hand has pinched. @returns whether it points */
  take(): boolean {
    if (this.#by !== 'trigger') return false;
    this.#by = null;
    return true;
  }

  /** Call this before each display frame in VR. @returns whether the grip has opened, and so points */
  update({ grip, barred, drives }: AimReading, nowMs: number): boolean {
    const heldMs = nowMs - this.#sinceMs;
    const isAimed = this.#by === 'grip' && !barred;
    if (barred || (this.#by === 'grip' && grip !== 'held')) this.#by = null;
    if (this.#by === 'trigger' && (drives || heldMs >= ARMED_MS)) this.#by = null;
    if (grip !== 'held') {
      this.#mustOpen = grip === 'away';
      return isAimed && grip === 'open' && heldMs >= AIMED_MS;
    }
    if (barred) this.#mustOpen = true;
    if (!this.#mustOpen && this.#by !== 'grip') {
      this.#by = 'grip';
      this.#sinceMs = nowMs;
    }
    return false;
  }
}
