/** Room around panels, CSS pixels. Chosen by eye. */
export const MARGIN = 8;
/** Two rows: less is of no use, pixels. */
const LEAST = 68;

export interface Edges {
  readonly left: number;
  readonly right: number;
  readonly top: number;
}

/**
 * Height of a box that ends above everything below it.
 *
 * @param box     where it begins
 * @param below   what it must not cover; what is beside it does not count
 * @param screenHeight all in pixels
 */
export function roomAbove(box: Edges, below: readonly Edges[], screenHeight: number): number {
  const tops = below
    .filter(({ left, right, top }) => left < box.right && right > box.left && top > box.top)
    .map(({ top }) => top);
  return Math.max(LEAST, Math.floor(Math.min(screenHeight, ...tops) - box.top - MARGIN));
}
