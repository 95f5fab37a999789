// What these numbers give together with the others: see adaptive-rate-controller.ts.

/** A loss fraction is judged over at least this many packets and this much time. */
const LEAST_PACKETS = 60;
const LEAST_MS = 180;
/** On a slow link, this many packets suffice after this time. */
const FEW_PACKETS = 20;
const PATIENCE_MS = 1000;
/** Loss must exceed the base by this margin, and by this many standard deviations, before the controller acts. */
const MARGIN = 0.03;
const DEVIATIONS = 3;
/**
 * Per window: how fast the base follows the loss when the loss is well below it, and otherwise; and how fast a trial's
 * result is forgotten.
 */
const FAST = 0.3;
const SLOW = 0.1;
const FORGET = 0.02;

/**
 * What the judge concludes. `excess`: cut to below what got through; `innocent`: the cut made no difference; `guilty`:
 * the cut ended the loss.
 */
export type LossVerdict = 'none' | 'excess' | 'innocent' | 'guilty';

/**
 * Tells loss caused by overload from loss that is simply there (radio, somebody else's policer). The test is causal.
 * When loss exceeds its base, the rate is cut to below what got through. That would end loss by overload. If the loss
 * stays, it is the link's own: the base rises to it, and the rate is restored.
 */
export class LossJudge {
  /** Loss that no lower rate has reduced, 0–1. */
  base = 0;
  /** Loss fraction of the last judged window, 0–1. */
  fraction = 0;
  /** The loss that a trial has shown to be the link's own; it is forgotten slowly. */
  #proven = 0;
  #received = 0;
  #lost = 0;
  #sinceMs = Number.NaN;
  /** A cut is on trial: packets sent from this time on are the evidence. */
  #trialFromMs = Number.NaN;
  #trialLoss = 0;

  get onTrial(): boolean {
    return !Number.isNaN(this.#trialFromMs);
  }

  /**
   * @param oldestSentMs when the first packet of the message was sent
   * @returns `excess`: cut to below the delivered rate now; `innocent`: the cut made no difference, so take it back
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

  /** Records that the rate was cut at this time because of `excess`. */
  cutAt(nowMs: number): void {
    this.#trialFromMs = nowMs;
    this.#restart();
  }

  /** Discards the losses so far, for example after an outage. */
  forget(): void {
    this.#trialFromMs = Number.NaN;
    this.#restart();
  }

  /** The base follows the loss, but never above what a trial has shown. */
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
