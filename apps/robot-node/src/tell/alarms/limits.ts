/** Judges one quantity against its limits. No clock and no configuration file here. */
import type { ReadingLevel } from '@farpoint/protocol';

/** Limits in the quantity's unit. Those below or above which a value is a warning or an error. */
export interface Limits {
  readonly low?: { readonly warn?: number | undefined; readonly error?: number | undefined } | undefined;
  readonly high?: { readonly warn?: number | undefined; readonly error?: number | undefined } | undefined;
  /** How far a value must come back from a limit before the limit counts as kept again. 0 or more. */
  readonly hysteresis: number;
}

export interface Verdict {
  readonly level: ReadingLevel;
  /** Which side is exceeded, or was last. */
  readonly side: 'low' | 'high';
  /** The limit that gives the level; if `ok`, the one that was last exceeded, or `null` if none was. */
  readonly limit: number | null;
}

interface Threshold {
  readonly level: 'warn' | 'error';
  readonly side: 'low' | 'high';
  readonly limit: number;
  exceeded: boolean;
}

export class LimitJudge {
  /** Errors first. */
  readonly #thresholds: readonly Threshold[];
  readonly #hysteresis: number;
  #verdict: Verdict = { level: 'ok', side: 'high', limit: null };

  constructor({ low, high, hysteresis }: Limits) {
    this.#hysteresis = hysteresis;
    this.#thresholds = (['error', 'warn'] as const).flatMap((level) => {
      const [below, above] = [low?.[level], high?.[level]];
      return [
        ...(below === undefined ? [] : [{ level, side: 'low' as const, limit: below, exceeded: false }]),
        ...(above === undefined ? [] : [{ level, side: 'high' as const, limit: above, exceeded: false }]),
      ];
    });
  }

  get verdict(): Verdict {
    return this.#verdict;
  }

  /** Takes a finite value. @returns whether the level, or the side that is exceeded, has changed */
  take(value: number): boolean {
    for (const threshold of this.#thresholds) {
      const beyond = threshold.side === 'low' ? threshold.limit - value : value - threshold.limit;
      threshold.exceeded = beyond > (threshold.exceeded ? -this.#hysteresis : 0);
    }
    const worst = this.#thresholds.find(({ exceeded }) => exceeded);
    const before = this.#verdict;
    if (worst === undefined) {
      if (before.level !== 'ok') this.#verdict = { ...before, level: 'ok' };
    } else if (before.level !== worst.level || before.side !== worst.side) {
      this.#verdict = { level: worst.level, side: worst.side, limit: worst.limit };
    }
    return this.#verdict !== before;
  }
}
