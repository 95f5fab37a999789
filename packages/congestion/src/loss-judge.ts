/** A fraction is judged over so many packets and so long. */
const LEAST_PACKETS = 60;
const LEAST_MS = 180;
/** On a slow link so few packets must do after so long. */
const FEW_PACKETS = 20;
const PATIENCE_MS = 1000;
/** Loss must exceed the base by so much before anything is done, and by so many standard deviations. */
const MARGIN = 0.03;
const DEVIATIONS = 3;
/** How fast the base follows the loss where it is far below it, and otherwise; and how fast a trial is forgotten. Per window. */
const FAST = 0.3;
const SLOW = 0.1;
const FORGET = 0.02;

/**
 * Tells loss by overload from loss that is simply there (radio, a policer of someone else's). The test is causal: when loss
 * exceeds its base, the rate is cut to below what got through. Overload would end with that. If the loss stays as it was,
 * it is the link's own: the base rises to it, and the rate is given back.
 */
/** `excess`: cut to below what got through; `innocent`: the cut changed nothing; `guilty`: it ended the loss. */
export type LossVerdict = 'none' | 'excess' | 'innocent' | 'guilty';

export class LossJudge {
  /** Loss that no lower rate has cured, 0–1. */
  base = 0;
  /** Of the last judged window, 0–1. */
  fraction = 0;
  /** What a trial has shown to be the link's own; forgotten slowly. */
  #proven = 0;
  #received = 0;
  #lost = 0;
  #sinceMs = Number.NaN;
  /** A cut is on trial: packets sent from this time on are its evidence. */
  #trialFromMs = Number.NaN;
  #trialLoss = 0;

  get onTrial(): boolean {
    return !Number.isNaN(this.#trialFromMs);
  }

  /**
   * @param oldestSentMs when the first packet of the message left
   * @returns `excess`: cut to below the delivered rate, now; `innocent`: the cut changed nothing, take it back
   */
  onFeedback(received: number, lost: number, oldestSentMs: number, nowMs: number): LossVerdict {
    if (this.onTrial && oldestSentMs < this.#trialFromMs) return 'none';
    if (Number.isNaN(this.#sinceMs)) this.#sinceMs = nowMs - 60;
    this.#received += received;
    this.#lost += lost;
    const n = this.#received + this.#lost;
    const elapsedMs = nowMs - this.#sinceMs;
    if (n < (elapsedMs < PATIENCE_MS ? LEAST_PACKETS : FEW_PACKETS) || elapsedMs < LEAST_MS) return 'none';
    const fraction = this.#lost / n;
    this.fraction = fraction;
    this.#restart();
    if (this.onTrial) {
      this.#trialFromMs = Number.NaN;
      if (fraction - this.base > 0.5 * (this.#trialLoss - this.base)) {
        this.base = fraction;
        this.#proven = fraction;
        return 'innocent';
      }
      this.#follow(fraction);
      return 'guilty';
    }
    const deviation = Math.sqrt((this.base * (1 - this.base)) / n);
    if (fraction > this.base + Math.max(MARGIN, DEVIATIONS * deviation)) {
      this.#trialLoss = fraction;
      return 'excess';
    }
    this.#follow(fraction);
    return 'none';
  }

  /** The rate was cut at this time because of `excess`. */
  cutAt(nowMs: number): void {
    this.#trialFromMs = nowMs;
    this.#restart();
  }

  /** What was lost so far says nothing, as after an outage. */
  forget(): void {
    this.#trialFromMs = Number.NaN;
    this.#restart();
  }

  /** The base goes with the loss, but never above what a trial has shown. */
  #follow(fraction: number): void {
    const gain = fraction < this.base - MARGIN ? FAST : SLOW;
    this.base = Math.min(this.base + (fraction - this.base) * gain, Math.max(this.#proven, this.base));
    this.#proven += (this.base - this.#proven) * FORGET;
  }

  #restart(): void {
    this.#received = 0;
    this.#lost = 0;
    this.#sinceMs = Number.NaN;
  }
}
