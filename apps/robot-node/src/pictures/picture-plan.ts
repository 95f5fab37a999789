/** How large pictures are, and how many a second, so that they fit what the path leaves them. */

import { MAX_PICTURE_BYTES } from '@farpoint/protocol';
import { BitRate } from '@farpoint/timing';
import type { CameraPlan } from './picture-messages.ts';

export interface PicturePolicy {
  /** Most pictures a second of a camera. */
  perSecond: number;
  /** Longest side, pixels. */
  longestSide: number;
  /** Of JPEG, 1–100. */
  quality: number;
  /** Most of what the path is thought to carry, 0–1. */
  share: number;
}

/** Below this pictures get nothing, bit/s: clouds and commands need it all. */
const LEAST_TARGET = 0.5e6;
/** From here on they may take their whole share. */
const FULL_SHARE_TARGET = 4e6;
/** Data channels of a path with loss and delay carry little more, whatever their number: messages go by them, too. */
const MOST_PICTURES = 3e6;
/** Fewer are no moving picture: they are made smaller then. */
const LEAST_PER_SECOND = 2;
/** By how much more they must fit before they are made larger again. */
const LARGER_MARGIN = 1.4;
/** Of the configured side. */
const SCALES = [1, 1 / 2, 1 / 4];
/** Before the first one is made, bytes a pixel. */
const FIRST_BYTES_PER_PIXEL = 0.12;
/** How bytes grow with the side: a quarter of the pixels has more than a quarter of the bytes, as it has more detail in each. */
const BYTES_BY_SIDE = 1.5;
/** Header of a chunk, and of all that carries it, as a share of its data. */
const OVERHEAD = 1.1;

/** What pictures may take of a path that carries so much, bit/s on the wire. */
export function pictureAllowance(targetBitsPerSecond: number, share: number): number {
  const ramp = (targetBitsPerSecond - LEAST_TARGET) / (FULL_SHARE_TARGET - LEAST_TARGET);
  const allowed = targetBitsPerSecond * share * Math.min(Math.max(ramp, 0), 1);
  return Math.min(allowed, MOST_PICTURES);
}

/** Plans one camera's pictures; remembers how large they were. */
export class PicturePlanner {
  readonly #policy: PicturePolicy;
  #scale = 0;
  /** Of a picture at the configured side, bytes. */
  #fullBytes: number;

  constructor(policy: PicturePolicy) {
    this.#policy = policy;
    this.#fullBytes = policy.longestSide * policy.longestSide * 0.75 * FIRST_BYTES_PER_PIXEL;
  }

  /** @param longestSide that it was made for */
  onMade(bytes: number, longestSide: number): void {
    this.#fullBytes = bytes * (this.#policy.longestSide / longestSide) ** BYTES_BY_SIDE;
  }

  /** @param bitsPerSecond of this camera on the wire; 0 stops it */
  plan(bitsPerSecond: number): CameraPlan {
    const { perSecond: most, longestSide, quality } = this.#policy;
    const bytesPerSecond = BitRate.toBytesPerSecond(bitsPerSecond) / OVERHEAD;
    const rateAt = (scale: number) =>
      bytesPerSecond / (this.#fullBytes * (SCALES[scale] as number) ** BYTES_BY_SIDE);
    const least = Math.min(LEAST_PER_SECOND, most);
    while (this.#scale < SCALES.length - 1 && rateAt(this.#scale) < least) this.#scale++;
    while (this.#scale > 0 && rateAt(this.#scale - 1) > least * LARGER_MARGIN) this.#scale--;
    return {
      // Rounded, so that a plan is not another one at each breath of the link.
      perSecond: bitsPerSecond > 0 ? Math.min(most, Math.floor(rateAt(this.#scale) * 20) / 20) : 0,
      longestSide: Math.max(16, Math.round(longestSide * (SCALES[this.#scale] as number))),
      quality,
      mostFileSide: longestSide,
      mostFileBytes: Math.min(MAX_PICTURE_BYTES, Math.floor(bytesPerSecond / least)),
    };
  }
}
