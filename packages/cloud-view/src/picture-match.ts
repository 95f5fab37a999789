/**
 * Which of a camera's pictures paint which frames of its cloud: those of the same capture instant. No GPU here: layers
 * of a texture, and instants.
 *
 * Instants are in µs on the robot's clock, modulo 2³².
 */
import { isSameInstant } from '@farpoint/operator';
import { sequenceDelta32 } from '@farpoint/protocol';

/** How many of the cloud's newest frames are known. As many as have tiles (tile-map.ts). */
const FRAMES_KEPT = 64;

export class PictureMatch {
  /** The instant of the picture in each layer; `null`: none. */
  #instants: (number | null)[] = [];
  /** How many pictures had come when a layer's came. */
  #came: number[] = [];
  readonly #frames: number[] = [];
  #nextFrame = 0;
  #newestFrame: number | null = null;
  #pictures = 0;

  /** @param layers how many pictures are kept */
  constructor(layers: number) {
    this.forgetPictures(layers);
  }

  /** A frame of the cloud has come. */
  expect(instantUs: number): void {
    if (this.isFrame(instantUs)) return;
    this.#frames[this.#nextFrame] = instantUs;
    this.#nextFrame = (this.#nextFrame + 1) % FRAMES_KEPT;
    const newest = this.#newestFrame;
    if (newest === null || sequenceDelta32(instantUs, newest) > 0) this.#newestFrame = instantUs;
  }

  /** Whether the cloud has a frame of this instant. */
  isFrame(instantUs: number): boolean {
    for (const frame of this.#frames) if (isSameInstant(frame, instantUs)) return true;
    return false;
  }

  /**
   * The layer that a picture is to be written to. It replaces one that will paint nothing, or else the oldest. `null`: no
   * frame of the cloud was captured with it, and none will come.
   */
  place(instantUs: number): number | null {
    const same = this.layerOf(instantUs);
    if (same !== null) return same;
    if (!this.#mayPaint(instantUs)) return null;
    const layer = this.#cheapest();
    this.#instants[layer] = instantUs;
    this.#came[layer] = ++this.#pictures;
    return layer;
  }

  /** The layer with the picture of this instant; `null` if there is none. */
  layerOf(instantUs: number): number | null {
    for (let layer = 0; layer < this.#instants.length; layer++) {
      const has = this.#instants[layer] ?? null;
      if (has !== null && isSameInstant(has, instantUs)) return layer;
    }
    return null;
  }

  /** The pictures are gone, e.g. with the GPU's memory. @param layers how many are kept from now on */
  forgetPictures(layers = this.#instants.length): void {
    this.#instants = new Array<number | null>(layers).fill(null);
    this.#came = new Array<number>(layers).fill(0);
  }

  /** Everything is: another session begins. */
  forget(): void {
    this.forgetPictures();
    this.#frames.length = 0;
    this.#nextFrame = 0;
    this.#newestFrame = null;
  }

  /** An empty layer, else the oldest of those that will paint nothing, else the oldest. */
  #cheapest(): number {
    let best = 0;
    let bestCost = Number.POSITIVE_INFINITY;
    for (let layer = 0; layer < this.#instants.length; layer++) {
      const instant = this.#instants[layer] ?? null;
      if (instant === null) return layer;
      const cost = (this.#came[layer] as number) + (this.#mayPaint(instant) ? this.#pictures : 0);
      if (cost < bestCost) [best, bestCost] = [layer, cost];
    }
    return best;
  }

  /** Its frame has come, or may still come. */
  #mayPaint(instantUs: number): boolean {
    const newest = this.#newestFrame;
    return newest === null || sequenceDelta32(instantUs, newest) > 0 || this.isFrame(instantUs);
  }
}
