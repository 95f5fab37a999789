/** Sizes and places of what is drawn into a saved picture. Pure. */

export interface PictureSize {
  readonly width: number;
  readonly height: number;
}

export interface PlacedBox extends PictureSize {
  readonly left: number;
  readonly top: number;
}

/**
 * A size with the view's proportions.
 *
 * @param view in pixels of the screen
 * @param mostSide larger views are made smaller
 * @returns even sides, as video encoders want them, 2 at least
 */
export function pictureSize({ width, height }: PictureSize, mostSide: number): PictureSize {
  const scale = Math.min(1, mostSide / Math.max(width, height, 1));
  const even = (side: number) => Math.max(2, Math.floor((side * scale) / 2) * 2);
  return { width: even(width), height: even(height) };
}

/** The largest box of the content's proportions within another, in its middle. */
export function contained({ left, top, width, height }: PlacedBox, content: PictureSize): PlacedBox {
  const scale = Math.min(width / Math.max(content.width, 1), height / Math.max(content.height, 1));
  const inner = { width: content.width * scale, height: content.height * scale };
  return { left: left + (width - inner.width) / 2, top: top + (height - inner.height) / 2, ...inner };
}
