/** What the tints of hazards mean, and that they mean nothing where the robot does not say what it would hit. */
import type { BodyHeights } from '@farpoint/operator';

/** What is tinted as a thing that the robot would hit, and as missing floor; or why nothing is. */
export type HazardWords =
  | { readonly hit: string; readonly drop: string; readonly unknown?: never }
  | { readonly unknown: string };

/** For the legend. @param heights `null`: the robot does not say */
export function hazardLegendWords(heights: BodyHeights | null): HazardWords {
  if (heights === null) return { unknown: 'hazards: robot’s height unknown' };
  const { clearanceM, heightM, dropM } = heights;
  return {
    hit: `would hit: ${clearanceM.toFixed(2)}–${heightM.toFixed(2)} m`,
    drop: `drop: below −${dropM.toFixed(2)} m`,
  };
}

/** What a key has done. */
export function hazardNotice(on: boolean, heights: BodyHeights | null): string {
  if (!on) return 'Hazards are not tinted.';
  return heights === null
    ? 'Hazards cannot be tinted: this robot does not say which heights matter to it.'
    : 'Red: the robot would hit it. Violet: the floor is missing.';
}

/** For the wrist panel; `null`: nothing to say. */
export function hazardHint(on: boolean, heights: BodyHeights | null): string | null {
  if (!on) return null;
  return heights === null ? 'No hazard tint' : 'Red: would hit  violet: drop';
}
