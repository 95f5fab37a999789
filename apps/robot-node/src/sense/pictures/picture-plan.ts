/** Plans the size of pictures and their rate, so that they fit their share of the path. */

import { MAX_PICTURE_BYTES } from '@farpoint/protocol';
import { BitRate } from '@farpoint/timing';
import { LEAST_CLOUD_BITS_PER_SECOND } from '../encode/capture-budget.ts';
import { LARGER_MARGIN } from '../video/video-plan.ts';
import type { CameraPlan } from './picture-messages.ts';

export interface PicturePolicy {
  /** Highest number of pictures per second of a camera. */
  perSecond: number;
  /** Longest side, pixels. */
  longestSide: number;
  /** JPEG quality, 1–100. */
  quality: number;
  /** Highest share of the path's estimated rate, 0–1. */
  share: number;
}

/**
 * From this rate on, pictures may use their whole share. Chosen: 15 % are 600 kbit/s there, two pictures of
 * 37 kB a second. picture-plan.test.ts holds it and those that follow.
 */
const FULL_SHARE_TARGET = 4e6;
/**
 * Data channels carry little more on a path with loss and delay, however many there are, bit/s. Messages use
 * them, too. docs/ros.md has pictures over such paths.
 */
const MOST_PICTURES = 3e6;
/**
 * At fewer pictures per second there is no impression of motion. Pictures become smaller instead. Chosen by
 * eye.
 */
export const LEAST_PICTURES_PER_SECOND = 2;
/** Factors of the configured side. */
const SCALES = [1, 1 / 2, 1 / 4];
/**
 * Assumed size before the first picture is made, bytes per pixel. Measured: 41 kB for 640 × 480 (docs/ros.md)
 * is 0.13.
 */
const FIRST_BYTES_PER_PIXEL = 0.12;
/**
 * Exponent of file size over side length. It is less than 2 because a smaller picture has more detail per
 * pixel. Measured: 41 kB and, halved in size, 14 kB (docs/ros.md): 2^1.55.
 */
const BYTES_BY_SIDE = 1.5;
/**
 * Factor for the headers of chunks and of all layers below: 20 and 93 bytes (operator-peer.ts) for 1,140 are
 * 9.9 %.
 */
const OVERHEAD = 1.1;

/** The bit rate that pictures may use on a path with this rate, bit/s on the wire. */
export function pictureAllowance(targetBitsPerSecond: number, share: number): number {
  const beyondClouds = targetBitsPerSecond - LEAST_CLOUD_BITS_PER_SECOND;
  const ramp = beyondClouds / (FULL_SHARE_TARGET - LEAST_CLOUD_BITS_PER_SECOND);
  const allowed = targetBitsPerSecond * share * Math.min(Math.max(ramp, 0), 1);
  return Math.min(allowed, MOST_PICTURES);
}

/** Plans one camera's pictures from the sizes of earlier ones. */
export class PicturePlanner {
  readonly #policy: PicturePolicy;
  #scale = 0;
  /** Estimated size of a picture at the configured side, bytes. */
  #fullBytes: number;

  constructor(policy: PicturePolicy) {
    this.#policy = policy;
    this.#fullBytes = policy.longestSide * policy.longestSide * 0.75 * FIRST_BYTES_PER_PIXEL;
  }

  /** @param longestSide the side that it was made for */
  onMade(bytes: number, longestSide: number): void {
    this.#fullBytes = bytes * (this.#policy.longestSide / longestSide) ** BYTES_BY_SIDE;
  }

  /** @param bitsPerSecond for this camera on the wire; 0 stops it */
  plan(bitsPerSecond: number): CameraPlan {
    const { perSecond: most, longestSide, quality } = this.#policy;
    const bytesPerSecond = BitRate.toBytesPerSecond(bitsPerSecond) / OVERHEAD;
    const rateAt = (scale: number) =>
      bytesPerSecond / (this.#fullBytes * (SCALES[scale] as number) ** BYTES_BY_SIDE);
    const least = Math.min(LEAST_PICTURES_PER_SECOND, most);
    while (this.#scale < SCALES.length - 1 && rateAt(this.#scale) < least) this.#scale++;
    while (this.#scale > 0 && rateAt(this.#scale - 1) > least * LARGER_MARGIN) this.#scale--;
    return {
      // Rounded, so that small changes of the link do not change the plan.
      perSecond: bitsPerSecond > 0 ? Math.min(most, Math.floor(rateAt(this.#scale) * 20) / 20) : 0,
      longestSide: Math.max(16, Math.round(longestSide * (SCALES[this.#scale] as number))),
      quality,
      mostFileSide: longestSide,
      mostFileBytes: Math.min(MAX_PICTURE_BYTES, Math.floor(bytesPerSecond / least)),
    };
  }
}
