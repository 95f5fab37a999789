import { ageOfStampMs } from '@farpoint/protocol';
import { ROUNDING_MS } from './operator-view.ts';

/**
 * How many pictures and clouds are remembered. Chosen: 2 s of eight videos at 30/s, above the age at which
 * any picture stops the robot.
 */
const KEPT = 512;
/** More than a robot takes operators. */
const MOST_OPERATORS = 64;

/**
 * When the pictures and clouds that each operator was sent lately were captured. A command may name any of them as what its
 * giver sees, and nothing else: what was never sent was not seen.
 */
export class SentViews {
  readonly #operators = new Map<string, OperatorViews>();

  /**
   * A picture or cloud is on its way to an operator.
   *
   * @param capturedMs robot's monotonic clock
   * @param exactMs how exactly the operator can name it, ms
   */
  sent(operatorId: string, capturedMs: number, exactMs = 0): void {
    let views = this.#operators.get(operatorId);
    if (views === undefined) {
      if (this.#operators.size >= MOST_OPERATORS)
        this.#operators.delete(this.#operators.keys().next().value as string);
      views = new OperatorViews();
      this.#operators.set(operatorId, views);
    }
    views.sent(capturedMs, Math.max(ROUNDING_MS, exactMs));
  }

  /**
   * How old what a command names as seen is, ms.
   *
   * @param seenUs as in a command; undefined if it names nothing
   * @returns `null` if it names nothing, or nothing that was sent to this operator lately
   */
  ageMs(operatorId: string, seenUs: number | undefined, nowMs: number): number | null {
    if (seenUs === undefined) return null;
    const capturedMs = this.#operators.get(operatorId)?.named(nowMs - ageOfStampMs(seenUs, nowMs)) ?? null;
    return capturedMs === null ? null : nowMs - capturedMs;
  }

  forget(operatorId: string): void {
    this.#operators.delete(operatorId);
  }
}

/** Those of one operator, in a ring. */
class OperatorViews {
  readonly #capturedMs = new Float64Array(KEPT).fill(Number.NEGATIVE_INFINITY);
  readonly #exactMs = new Float32Array(KEPT);
  #next = 0;

  sent(capturedMs: number, exactMs: number): void {
    this.#capturedMs[this.#next] = capturedMs;
    this.#exactMs[this.#next] = exactMs;
    this.#next = (this.#next + 1) % KEPT;
  }

  /** When that which is named by this time was captured, ms; `null` if nothing of it was sent. */
  named(capturedMs: number): number | null {
    let nearest: number | null = null;
    for (let i = 0; i < KEPT; i++) {
      const at = this.#capturedMs[i] as number;
      const off = Math.abs(at - capturedMs);
      if (!(off <= (this.#exactMs[i] as number))) continue;
      if (nearest === null || off < Math.abs(nearest - capturedMs)) nearest = at;
    }
    return nearest;
  }
}
