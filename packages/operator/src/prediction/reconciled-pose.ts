/**
 * What is shown of a predicted pose: it moves as the prediction does, and what a new report corrects is blended in over the
 * next frames, never faster than the eye forgives. Allocates nothing.
 */
import { type BaseMotion, standingAt } from './base-model.ts';

/** What gives the pose for an instant: {@link MotionPredictor}. */
export interface PoseSource {
  /** Changes when the pose has jumped to another place. */
  readonly jumps: number;
  poseAt(atMs: number, into: BaseMotion): void;
}

// `pnpm bench prediction` measures what these numbers give together (docs/prediction.md).

/** The most that one frame corrects, m and rad. */
export const MOST_CORRECTION_M = 0.03;
export const MOST_CORRECTION_RAD = (2 * Math.PI) / 180;
/** Time after which 63 % of a correction are done, ms. */
const BLEND_MS = 100;
/** A page that drew nothing for so long starts anew, ms. */
const PAUSE_MS = 500;
/** Further off than this, it is another place, m. */
const ELSEWHERE_M = 2;

export class ReconciledPose {
  x = 0;
  y = 0;
  /** Radians, not wrapped. */
  yaw = 0;
  /** What the latest frame corrected, m and rad. */
  correctedM = 0;
  correctedRad = 0;
  #atMs = Number.NEGATIVE_INFINITY;
  #jumps = -1;
  readonly #before: BaseMotion = standingAt();
  readonly #now: BaseMotion = standingAt();

  /** Makes the next pose apply at once. */
  reset(): void {
    this.#atMs = Number.NEGATIVE_INFINITY;
  }

  /** Call it once for each display frame. @param atMs when the frame is shown, operator's clock */
  follow(source: PoseSource, atMs: number): void {
    const elapsedMs = atMs - this.#atMs;
    source.poseAt(atMs, this.#now);
    const now = this.#now;
    let offX = 0;
    let offY = 0;
    let offYaw = 0;
    this.correctedM = 0;
    this.correctedRad = 0;
    if (elapsedMs <= PAUSE_MS && source.jumps === this.#jumps) {
      // By what is known now, how far off was the frame before?
      source.poseAt(this.#atMs, this.#before);
      offX = this.x - this.#before.x;
      offY = this.y - this.#before.y;
      offYaw = this.yaw - this.#before.yaw;
      const off = Math.hypot(offX, offY);
      if (off > ELSEWHERE_M) offX = offY = offYaw = 0;
      else {
        const share = -Math.expm1(-Math.max(elapsedMs, 0) / BLEND_MS);
        this.correctedM = Math.min(off * share, MOST_CORRECTION_M);
        this.correctedRad = Math.min(Math.abs(offYaw) * share, MOST_CORRECTION_RAD);
        const keeps = off === 0 ? 0 : 1 - this.correctedM / off;
        offX *= keeps;
        offY *= keeps;
        offYaw -= Math.sign(offYaw) * this.correctedRad;
      }
    }
    this.#jumps = source.jumps;
    this.#atMs = atMs;
    this.x = now.x + offX;
    this.y = now.y + offY;
    this.yaw = now.yaw + offYaw;
  }
}
