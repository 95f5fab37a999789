/** Number of groups that the line is fitted to. */
const WINDOW = 20;
/** Share of the smoothed delay that is kept with each group. */
const SMOOTHING = 0.9;

/**
 * The trend of the one-way delay: a least-squares line through the smoothed delay over the arrival times of the
 * latest groups. It replaces the draft's Kalman filter (draft-ietf-rmcat-gcc-02, section 5.3), as in libwebrtc since
 * 2016.
 */
export class Trendline {
  readonly #times = new Float64Array(WINDOW);
  readonly #delays = new Float64Array(WINDOW);
  #count = 0;
  #firstMs = 0;
  #delayMs = 0;
  #smoothedMs = 0;
  #slope = 0;

  /** Number of groups so far. */
  get count(): number {
    return this.#count;
  }

  /**
   * @returns the slope, ms of delay per ms: the share by which more is sent than gets through; 0 until the window is
   * full
   */
  add(sentDeltaMs: number, arrivalDeltaMs: number, arrivedMs: number): number {
    if (this.#count === 0) this.#firstMs = arrivedMs;
    this.#delayMs += arrivalDeltaMs - sentDeltaMs;
    this.#smoothedMs = SMOOTHING * this.#smoothedMs + (1 - SMOOTHING) * this.#delayMs;
    const at = this.#count++ % WINDOW;
    this.#times[at] = arrivedMs - this.#firstMs;
    this.#delays[at] = this.#smoothedMs;
    if (this.#count >= WINDOW) this.#slope = this.#fit() ?? this.#slope;
    return this.#slope;
  }

  #fit(): number | null {
    let time = 0;
    let delay = 0;
    for (let i = 0; i < WINDOW; i++) {
      time += (this.#times[i] as number) / WINDOW;
      delay += (this.#delays[i] as number) / WINDOW;
    }
    let covariance = 0;
    let variance = 0;
    for (let i = 0; i < WINDOW; i++) {
      const t = (this.#times[i] as number) - time;
      covariance += t * ((this.#delays[i] as number) - delay);
      variance += t * t;
    }
    return variance > 0 ? covariance / variance : null;
  }
}
