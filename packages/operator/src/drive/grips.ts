/** Decides which dead-man grips count as held. Pure: time is an argument. */
import type { DriveInput } from './drive-input.ts';

/**
 * A grip moves the robot only while its device is read at least this often, ms. Shorter than the 150 ms after
 * which the robot brakes without a word, and four times the usual 25 ms.
 */
export const READING_HOLDS_MS = 100;

/** Why a grip that is held does not drive until it has been opened. */
export type GripLoss =
  | 'late-reading' // its device was not read for longer than the robot allows: the page or the headset hung, or tracking was lost
  | 'hands-away' // the page was hidden or lost the focus, or the headset was taken off
  | 'path-lost' // the path to the robot was lost or restored
  | 'other-drives' // it was closed while another operator drove, or when that one handed the drive over
  | 'let-go'; // the page let go: the session ended, or another robot was chosen

interface Reading {
  readMs: number | null;
  held: boolean;
  loss: GripLoss | null;
  /** Whether the latest reading is too old to drive by. */
  isLate: boolean;
}

/**
 * A hand whose device is not read may have let go. Its grip moves nothing until a fresh reading finds it held; if that
 * takes longer than the robot allows, it counts as released, and drives again only after a reading has found it open.
 * The same holds for grips that were held while nobody could watch the robot.
 */
export class Grips {
  /** The longest time between two readings of a grip that stays held, as the robot allows, ms. */
  resumeWithinMs = 0;
  readonly #readings = new Map<DriveInput, Reading>();

  /**
   * Takes note of every device's state. Call it whenever something may be sent, before {@link holds}.
   *
   * @param away whether no grip may drive now
   * @returns why a grip that had been held until now was lost; `null` if none was
   */
  update(inputs: readonly DriveInput[], nowMs: number, away: boolean): GripLoss | null {
    const longestMs = Math.max(READING_HOLDS_MS, this.resumeWithinMs);
    let lost: GripLoss | null = null;
    for (const input of inputs) {
      const before = this.#of(input);
      const { readMs, held } = input;
      const ageMs = readMs === null ? 0 : Math.abs(nowMs - readMs);
      // Devices are read before ticks: after a hang the first reading is fresh again, but the hand was unwatched.
      const gapMs = readMs === null || before.readMs === null || !before.held ? 0 : readMs - before.readMs;
      const isLate = !(ageMs <= READING_HOLDS_MS);
      let { loss } = before;
      if (!held && !isLate) loss = null;
      else if (held && loss === null) {
        if (away) loss = 'hands-away';
        else if (!(ageMs <= longestMs) || !(gapMs <= longestMs)) loss = 'late-reading';
        if (before.held) lost ??= loss;
      }
      before.loss = loss;
      before.isLate = isLate;
      before.readMs = readMs;
      before.held = held;
    }
    return lost;
  }

  /** Every grip that is held now counts as released until it has been opened. */
  lose(inputs: readonly DriveInput[], loss: GripLoss): void {
    for (const input of inputs) {
      const reading = this.#of(input);
      if (input.held || reading.held) reading.loss ??= loss;
    }
  }

  /** Whether this grip counts as held, even if it moves nothing now. */
  holds(input: DriveInput): boolean {
    return input.held && this.lossOf(input) === null;
  }

  /** Whether this grip counts as held, but was not read recently enough to move anything. */
  isUnread(input: DriveInput): boolean {
    return this.holds(input) && this.#readings.get(input)?.isLate === true;
  }

  /** Why this grip does not drive although it is held; `null` if nothing prevents it. */
  lossOf(input: DriveInput): GripLoss | null {
    return this.#readings.get(input)?.loss ?? null;
  }

  #of(input: DriveInput): Reading {
    let reading = this.#readings.get(input);
    if (reading === undefined) {
      reading = { readMs: null, held: false, loss: null, isLate: false };
      this.#readings.set(input, reading);
    }
    return reading;
  }
}
