/** Where a panel is on the screen. Pure: sizes in CSS pixels are arguments. */

/** A part of the screen. */
export interface Box {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

/** Where an operator has put a panel. It holds for a screen of any size. */
export interface Placement {
  /** Share of the room left of the panel in all the room beside it, 0–1; `y` the same from above. */
  readonly x: number;
  readonly y: number;
  /** Wanted width, CSS pixels. */
  readonly width: number;
}

/** What a panel needs: its picture keeps its sides' ratio. */
export interface PanelShape {
  /** Width over height of the picture; `null` while there is none. */
  readonly aspect: number | null;
  /** Height of everything else in the panel, and width of what is left and right of the picture, CSS pixels. */
  readonly besides: number;
  readonly border: number;
}

/** A panel is no narrower, if the screen is not, CSS pixels. Chosen: its name and its button fit. */
export const LEAST_WIDTH = 140;

/** Where the panel is drawn: entirely within the area. */
export function boxOf({ x, y, width }: Placement, { aspect, besides, border }: PanelShape, area: Box): Box {
  const widest = Math.min(
    area.width,
    aspect === null ? area.width : (area.height - besides) * aspect + border,
  );
  const shown = Math.max(0, Math.min(Math.max(width, LEAST_WIDTH), widest));
  const height = besides + (aspect === null ? 0 : Math.max(0, shown - border) / aspect);
  return {
    left: area.left + x * (area.width - shown),
    top: area.top + y * Math.max(0, area.height - height),
    width: shown,
    height,
  };
}

/** The placement of a panel that is drawn there, or as near to it as it can be. */
export function placementOf({ left, top, width, height }: Box, area: Box): Placement {
  return {
    x: shareOf(left - area.left, area.width - width),
    y: shareOf(top - area.top, area.height - height),
    width,
  };
}

/** The panel pushed by this far. */
export function moved(box: Box, dx: number, dy: number, area: Box): Placement {
  return placementOf({ ...box, left: box.left + dx, top: box.top + dy }, area);
}

/** The panel made wider by this much, with its upper left corner where it was. */
export function resized(box: Box, shape: PanelShape, by: number, area: Box): Placement {
  const width = Math.max(LEAST_WIDTH, box.width + by);
  const wanted = boxOf({ x: 0, y: 0, width }, shape, area);
  return placementOf({ ...box, width: wanted.width, height: wanted.height }, area);
}

function shareOf(part: number, whole: number): number {
  return whole <= 0 ? 0 : Math.min(1, Math.max(0, part / whole));
}
