/**
 * Corrects what an encoder is asked for by what it gives. Encoders with a short buffer stay below their rate, by up to a
 * quarter, and would leave that part of the operator's share unused; others exceed it.
 */

/** Frames in each measurement. Shorter ones would follow single pictures. Chosen: a second at 30 a second. */
const WINDOW_FRAMES = 30;
/**
 * How far an encoder is trusted to be asked for something else than it shall give. `x264enc` stays 15 to 25 %
 * below what it is asked for (docs/video.md).
 */
const LEAST = 0.7;
const MOST = 1.3;
/**
 * Part of the difference that one measurement corrects. Too much is corrected in full, because others wait
 * for it. Chosen: single measurements vary with the pictures.
 */
const RISE = 0.5;

export class RateTrim {
  /** What to multiply the wanted rate with. */
  factor = 1;
  #frames = 0;
  #bytes = 0;
  #wantedBytes = 0;

  /**
   * Takes a picture into account.
   *
   * @param bytes of the picture
   * @param wantedBytes what it should have had on average
   * @returns whether the factor has changed
   */
  onPicture(bytes: number, wantedBytes: number): boolean {
    this.#frames++;
    this.#bytes += bytes;
    this.#wantedBytes += wantedBytes;
    if (this.#frames < WINDOW_FRAMES || this.#bytes === 0) return false;
    const error = this.#wantedBytes / this.#bytes - 1;
    this.reset();
    const before = this.factor;
    this.factor = Math.min(Math.max(this.factor * (1 + (error > 0 ? RISE * error : error)), LEAST), MOST);
    return this.factor !== before;
  }

  /** Begins a new measurement, as after a change of size, frame rate or bit rate. */
  reset(): void {
    this.#frames = 0;
    this.#bytes = 0;
    this.#wantedBytes = 0;
  }
}
