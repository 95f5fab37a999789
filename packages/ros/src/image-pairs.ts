/** Matches colour images to depth images: cameras take them together, or nearly so, and send them separately. */

/**
 * Images within this interval were taken together, ns: drivers write the same stamp, or that of a clock that jitters.
 */
const TOGETHER_NS = 3_000_000n;
/** A colour image further away than this is never paired with a depth image, ns. */
const FAR_NS = 100_000_000n;
/** After this long without colour images, depth continues without colour, ns. */
const COLOUR_GONE_NS = 1_000_000_000n;
/** Number of colour images kept. */
const KEPT = 3;

export interface Stamped {
  stampNs: bigint;
}

export interface ImagePair<Image> {
  depth: Image;
  /** `null` if there is none close enough. */
  colour: Image | null;
}

/**
 * Pairs images by their stamps. A depth image waits for its colour image until a later one shows that it will not come,
 * at most until the next depth image. Images that are no longer needed go to `release`, which may reuse their memory.
 */
export class ImagePairs<Image extends Stamped> {
  readonly #release: (image: Image) => void;
  /** Oldest first. */
  readonly #colours: Image[] = [];
  #waiting: Image | null = null;
  #newestColourNs: bigint | null = null;
  #firstDepthNs: bigint | null = null;

  constructor(release: (image: Image) => void) {
    this.#release = release;
  }

  /**
   * @returns the pair that is now complete. The caller must release the depth image; `colour` still belongs to this
   * object
   */
  depth(image: Image): ImagePair<Image> | null {
    this.#firstDepthNs ??= image.stampNs;
    const before = this.#waiting;
    this.#waiting = image;
    const now = this.#match(this.#isTogether);
    if (now !== null) {
      if (before !== null) this.#release(before);
      return now;
    }
    const lastColourNs = this.#newestColourNs ?? this.#firstDepthNs;
    if (image.stampNs - lastColourNs > COLOUR_GONE_NS) {
      if (before !== null) this.#release(before);
      this.#waiting = null;
      return { depth: image, colour: null };
    }
    if (before === null) return null;
    // It has waited for as long as it may: pair it with the nearest colour image, or none.
    const colour = this.#nearest(before);
    if (colour !== null) return { depth: before, colour };
    this.#release(before);
    return null;
  }

  /** @returns as {@link depth} */
  colour(image: Image): ImagePair<Image> | null {
    this.#colours.push(image);
    this.#newestColourNs = image.stampNs;
    if (this.#colours.length > KEPT) this.#release(this.#colours.shift() as Image);
    return this.#match((depth, colour) => this.#isTogether(depth, colour) || image.stampNs > depth.stampNs);
  }

  readonly #isTogether = (depth: Image, colour: Image) => apart(depth, colour) <= TOGETHER_NS;

  #match(enough: (depth: Image, colour: Image) => boolean): ImagePair<Image> | null {
    const depth = this.#waiting;
    const colour = depth === null ? null : this.#nearest(depth);
    if (depth === null || colour === null || !enough(depth, colour)) return null;
    this.#waiting = null;
    return { depth, colour };
  }

  #nearest(depth: Image): Image | null {
    let nearest: Image | null = null;
    for (const colour of this.#colours) {
      if (nearest === null || apart(depth, colour) < apart(depth, nearest)) nearest = colour;
    }
    return nearest !== null && apart(depth, nearest) <= FAR_NS ? nearest : null;
  }
}

function apart(a: Stamped, b: Stamped): bigint {
  return a.stampNs > b.stampNs ? a.stampNs - b.stampNs : b.stampNs - a.stampNs;
}
