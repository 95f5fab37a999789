/**
 * The six digits by which somebody who sees this service's terminal lets a browser in. Pure: time and randomness are
 * arguments.
 *
 * A code exists only while a browser waits for it, lets one browser in, and dies with a few wrong guesses; then there
 * is none for a while. Somebody who guesses day and night, each time with a code in the terminal, so
 * has one chance in 300 a week.
 */

export const CODE_DIGITS = 6;
/** Long enough to take a headset off, read the code, and type it. */
export const CODE_MS = 5 * 60_000;
/** Wrong guesses that end a code. */
export const MOST_GUESSES = 3;
/** After them, no code is made for so long. */
export const PAUSE_MS = 10 * 60_000;

export type PairingAnswer =
  | 'paired'
  | 'wrong' // there are guesses left
  | 'used-up' // that was the last guess
  | 'expired' // or there is none
  | 'paused';

interface Code {
  readonly digits: string;
  readonly untilMs: number;
  guesses: number;
}

export interface PairingCodesOptions {
  /** A uniformly random integer from 0 to `below` − 1, which nobody can guess. */
  readonly random: (below: number) => number;
  /** Show it to whoever runs the service, and to nobody else. */
  readonly onCode: (digits: string, untilMs: number) => void;
}

export class PairingCodes {
  readonly #options: PairingCodesOptions;
  #code: Code | null = null;
  #pausedUntilMs = Number.NEGATIVE_INFINITY;

  constructor(options: PairingCodesOptions) {
    this.#options = options;
  }

  /** A browser waits for a code: makes and shows one, unless there is one. @returns false while guesses are paused */
  ask(nowMs: number): boolean {
    if (nowMs < this.#pausedUntilMs) return false;
    if (this.#code === null || nowMs >= this.#code.untilMs) {
      const digits = String(this.#options.random(10 ** CODE_DIGITS)).padStart(CODE_DIGITS, '0');
      this.#code = { digits, untilMs: nowMs + CODE_MS, guesses: 0 };
      this.#options.onCode(digits, this.#code.untilMs);
    }
    return true;
  }

  /** @param typed as typed; spaces and dashes do not matter */
  guess(typed: string, nowMs: number): PairingAnswer {
    if (nowMs < this.#pausedUntilMs) return 'paused';
    const code = this.#code;
    if (code === null || nowMs >= code.untilMs) {
      this.#code = null;
      return 'expired';
    }
    if (typed.replace(/[\s-]/g, '') === code.digits) {
      this.#code = null;
      return 'paired';
    }
    code.guesses += 1;
    if (code.guesses < MOST_GUESSES) return 'wrong';
    this.#code = null;
    this.#pausedUntilMs = nowMs + PAUSE_MS;
    return 'used-up';
  }
}
