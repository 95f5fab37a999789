/** The size of a clip's pictures. Pure. */

export interface ClipSize {
  readonly width: number;
  readonly height: number;
}

/** Larger pictures are made smaller: a clip shows what happened, and coding it must not slow down what is happening. */
const MOST_SIDE = 1280;

/** @returns the canvas's proportions with even sides, as coders want them, 2 at least */
export function clipSize({ width, height }: ClipSize): ClipSize {
  const scale = Math.min(1, MOST_SIDE / Math.max(width, height, 1));
  const even = (side: number) => Math.max(2, Math.floor((side * scale) / 2) * 2);
  return { width: even(width), height: even(height) };
}
