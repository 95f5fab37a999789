/** Plans a camera's picture size and frame rate, so that its bit rate still makes pictures. */

/** What a camera is configured for, at most. */
export interface VideoFormat {
  width: number;
  height: number;
  framesPerSecond: number;
  /** Of the encoder, without headers. */
  bitsPerSecond: number;
}

/** What is encoded at present. */
export interface EncodedFormat extends VideoFormat {
  /** Whether the pictures carry their capture time as a barcode. */
  barcode: boolean;
}

/** Below this rate, a video gets nothing, bit/s: no size makes a picture of it. Chosen by eye. */
export const LEAST_VIDEO_BITS_PER_SECOND = 60_000;
/**
 * With fewer bits than this for each pixel of each frame, a smaller picture shows more. Chosen by eye: 1024 ×
 * 768 at 30/s needs 330 kbit/s, below all rates of docs/cameras.md.
 */
const LEAST_BITS_PER_PIXEL = 0.014;
/**
 * Margin before the picture becomes larger again, so that a changing rate does not change it all the time.
 * Chosen: above the 25 % that an encoder stays below its rate (docs/video.md); video-plan.test.ts holds it.
 */
export const LARGER_MARGIN = 1.4;
/** Steps from best to worst: factors of the sides and of the frame rate. */
const STEPS = [
  { side: 1, rate: 1 },
  { side: 3 / 4, rate: 1 },
  { side: 1 / 2, rate: 1 },
  { side: 1 / 2, rate: 1 / 2 },
  { side: 1 / 4, rate: 1 / 2 },
] as const;

/** Plans one camera. */
export class VideoPlanner {
  readonly #most: VideoFormat;
  #step = 0;

  constructor(most: VideoFormat) {
    this.#most = most;
  }

  /**
   * @param bitsPerSecond for the encoder
   * @returns what to encode; `null` if the rate does not carry a video
   */
  plan(bitsPerSecond: number): VideoFormat | null {
    if (bitsPerSecond < LEAST_VIDEO_BITS_PER_SECOND) return null;
    const rate = Math.min(bitsPerSecond, this.#most.bitsPerSecond);
    while (this.#step < STEPS.length - 1 && rate < this.#leastRate(this.#step)) this.#step++;
    while (this.#step > 0 && rate >= this.#leastRate(this.#step - 1) * LARGER_MARGIN) this.#step--;
    return { ...this.#format(this.#step), bitsPerSecond: Math.round(rate / 1000) * 1000 };
  }

  /** The lowest rate at which a step is worth its pixels, but never more than what the camera is configured for. */
  #leastRate(step: number): number {
    const { width, height, framesPerSecond } = this.#format(step);
    const least = width * height * framesPerSecond * LEAST_BITS_PER_PIXEL;
    // Whoever configures a large picture at a low rate wants it so while the path carries that rate.
    return Math.min(least, this.#most.bitsPerSecond / LARGER_MARGIN);
  }

  #format(step: number): Omit<VideoFormat, 'bitsPerSecond'> {
    const { side, rate } = STEPS[step] as (typeof STEPS)[number];
    const { width, height, framesPerSecond } = this.#most;
    return {
      // Encoders want even sides.
      width: Math.max(2, Math.round((width * side) / 2) * 2),
      height: Math.max(2, Math.round((height * side) / 2) * 2),
      framesPerSecond: framesPerSecond * rate,
    };
  }
}
