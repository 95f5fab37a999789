/** Finds that a link loses many packets, and that it no longer does. Pure. */
import type { EventDetail } from '../../ground/events/page-event.ts';

/**
 * Share of packets lost from which a link is poor, and below which it is not. Chosen: 2 % costs an unordered cloud nothing that
 * is seen, 5 % does; loss-events.test.ts holds both.
 */
const HIGH = 0.05;
const OVER = 0.02;

export class LossEvents {
  #isHigh = false;

  /** @param share of the packets of the last seconds, 0–1 @returns what is new; `null` if nothing is */
  observe(share: number): EventDetail | null {
    const percent = Math.round(share * 100);
    if (!this.#isHigh && share >= HIGH) {
      this.#isHigh = true;
      return { kind: 'loss-high', percent };
    }
    if (this.#isHigh && share < OVER) {
      this.#isHigh = false;
      return { kind: 'loss-over', percent };
    }
    return null;
  }

  /** A session begins. */
  reset(): void {
    this.#isHigh = false;
  }
}
