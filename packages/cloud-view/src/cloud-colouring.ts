/**
 * The ways to colour a cloud. `captured`: the points' own colours. `height`: metres above the robot's ground.
 * `distance`: metres from the sensor. `intensity`: of the LiDAR's echo, 0–1, or the brightness of a point with a colour
 * of its own. `age`: points of older frames are dim, seconds. The order is that of the shader's numbers.
 *
 * There is none by ring: no cloud format carries the beam that measured a point.
 */
export const COLOUR_MODES = ['captured', 'height', 'distance', 'intensity', 'age'] as const;

/** One of {@link COLOUR_MODES}. */
export type ColourMode = (typeof COLOUR_MODES)[number];

/** Values from the smallest to the largest, in the unit of the {@link ColourMode}. */
export interface ValueRange {
  /** The value with the first colour. */
  min: number;
  /** The value with the last colour. */
  max: number;
}

/** Heights between which points are drawn, metres above the robot's ground. `null`: not limited. */
export interface HeightCut {
  /** Points below it are not drawn. */
  below: number | null;
  /** Points above it are not drawn: the ceiling. */
  above: number | null;
}

/** How a cloud is coloured, and which heights of it are drawn. Changes apply to the next display frame. */
export interface CloudColouring {
  /** What the colours mean. Default: `captured`. */
  mode: ColourMode;
  /** The range of values; `null`, the default, follows the points in view slowly. */
  fixedRange: ValueRange | null;
  /** The range in use, for a legend. Of no meaning for `captured`. */
  readonly range: Readonly<ValueRange>;
  /** Height of the robot's ground in its world, metres: that of its `base_link`. */
  ground: number;
  /** Heights between which points are drawn. Default: all. */
  cut: Readonly<HeightCut>;
}
