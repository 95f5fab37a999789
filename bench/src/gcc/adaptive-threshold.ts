/** Bounds and initial value of `del_var_th`, ms. */
const LEAST = 6;
const MOST = 600;
const AT_START = 12.5;
/**
 * Per ms (`K_u`, `K_d`). These are libwebrtc's values for its trend line; the draft's 0.01 and 0.00018 belong to its
 * Kalman filter.
 */
const UP = 0.0087;
const DOWN = 0.039;
/** A trend this far above the threshold is a sudden event to which the threshold should not adapt. */
const OUTLIER = 15;
/** Longest time that counts at once, ms. */
const MOST_ELAPSED_MS = 100;

/**
 * Adaptive threshold (draft-ietf-rmcat-gcc-02, section 5.4). It follows the trend, so that a flow neither starves
 * beside one that fills the queue, nor mistakes the path's own jitter for over-use.
 */
export class AdaptiveThreshold {
  value = AT_START;
  #lastMs = Number.NaN;

  /** @param magnitude of the trend */
  update(magnitude: number, nowMs: number): void {
    const elapsedMs = Number.isNaN(this.#lastMs) ? 0 : nowMs - this.#lastMs;
    this.#lastMs = nowMs;
    if (magnitude > this.value + OUTLIER) return;
    const gain = magnitude < this.value ? DOWN : UP;
    const moved = this.value + gain * (magnitude - this.value) * Math.min(elapsedMs, MOST_ELAPSED_MS);
    this.value = Math.min(Math.max(moved, LEAST), MOST);
  }
}
