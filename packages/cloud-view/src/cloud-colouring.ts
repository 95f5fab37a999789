import type { Hazards } from './hazards.ts';
import type { SceneFigures } from './scene-estimate.ts';

/**
 * The ways to colour a cloud. `captured`: the points' own colours. `height`: metres above the robot's ground.
 * `distance`: metres from the sensor. `intensity`: of the LiDAR's echo, 0–1, or the brightness of a point with a colour
 * of its own. `age`: points of older frames are dim, seconds. `ring`: which of a spinning LiDAR's lasers measured the
 * point, by its elevation ({@link Rings}). `lit`: a surface's own colours, darker where it is turned away from the eye;
 * points, which have no surface, keep their colours. The order is that of the shader's numbers.
 */
export const COLOUR_MODES = ['captured', 'height', 'distance', 'intensity', 'age', 'ring', 'lit'] as const;

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

/**
 * The rings of a spinning LiDAR: the cones that its lasers sweep. No cloud format carries a point's ring, so the view
 * takes the one whose elevation, seen from the sensor, is nearest to the point's.
 */
export interface Rings {
  /** Elevation of each ring, radians above the horizontal plane of the sensor, ascending. Ring 0 is the lowest. */
  readonly elevations: readonly number[];
  /** `robot`: the robot knows them. `points`: estimated from the points, which may be wrong. */
  readonly from: 'robot' | 'points';
}

/** How a cloud is coloured, and which heights of it are drawn. Changes apply to the next display frame. */
export interface CloudColouring {
  /** What the colours mean. Default: `captured`. */
  mode: ColourMode;
  /** The range of values; `null`, the default, follows the points in view slowly. */
  fixedRange: ValueRange | null;
  /** The range in use, for a legend. Of no meaning for `captured`, `ring` and `lit`. */
  readonly range: Readonly<ValueRange>;
  /**
   * What the robot says about the rings: their elevations, radians, ascending, 2 to 256 of them. `null`, the default:
   * nothing; they are then estimated from the points.
   */
  knownRings: readonly number[] | null;
  /** The rings in use, for a legend; `null` until there are any: points then have their own colours. For `ring` only. */
  readonly rings: Rings | null;
  /** Height of the robot's ground in its world, metres: that of its `base_link`. */
  ground: number;
  /** Heights between which points are drawn. Default: all. */
  cut: Readonly<HeightCut>;
  /** What is tinted as a hazard, whatever else the colours mean. `null`, the default: nothing. */
  hazards: Hazards | null;
  /** What the cloud shows of the scene as a whole, from a few points of each frame. */
  readonly scene: SceneFigures;
}

/**
 * After this time without points the picture starts to turn grey; {@link STALE_FADE_MS} later it is grey.
 * Chosen: the robot has been braking since 400 ms (`motion.viewBrakeMs`), the page says that points are
 * missing after 3 s, and grey must be told from a stutter. cloud-colouring.test.ts holds both.
 */
const STALE_AFTER_MS = 600;
const STALE_FADE_MS = 1400;

/** From 1, live, to 0, grey: nobody may take an old picture for the present. @param pointsAtMs when points last came */
export function freshnessAt(nowMs: number, pointsAtMs: number): number {
  const stale = (nowMs - pointsAtMs - STALE_AFTER_MS) / STALE_FADE_MS;
  return 1 - Math.min(Math.max(stale, 0), 1);
}
