/** When the hands should feel that something new is written before the eyes: a refusal, a warning, a lost link. */
import type { Words } from '../../words/words.ts';

/** A vibration stands for all that is told within this time, ms. Chosen: a cause and what it brings about feel like one. */
const ONE_MS = 500;
/** The same words are felt again only after this, ms. Chosen: what a robot says to each command would never end. */
const SAME_MS = 5000;

/** Pure: time is an argument, on the page's clock, ms. */
export class NoticeJudge {
  #feltMs = Number.NEGATIVE_INFINITY;
  #text: string | null = null;
  #textMs = Number.NEGATIVE_INFINITY;
  #stood = false;

  /** The hands have felt something else. */
  onFelt(nowMs: number): void {
    this.#feltMs = nowMs;
  }

  /** @returns whether the hands should feel this notice */
  next({ text, tone }: Words, nowMs: number): boolean {
    if (tone !== 'warning' && tone !== 'bad') return false;
    const isSame = text === this.#text && nowMs - this.#textMs < SAME_MS;
    this.#text = text;
    this.#textMs = nowMs;
    return !isSame && this.#feel(nowMs);
  }

  /**
   * @param stands whether there is a banner, or an obstacle to a session
   * @returns whether the hands should feel that: once, whatever it says by and by
   */
  onStanding(stands: boolean, nowMs: number): boolean {
    const begins = stands && !this.#stood;
    this.#stood = stands;
    return begins && this.#feel(nowMs);
  }

  #feel(nowMs: number): boolean {
    if (nowMs - this.#feltMs < ONE_MS) return false;
    this.#feltMs = nowMs;
    return true;
  }
}
