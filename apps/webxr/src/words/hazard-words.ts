/** What the tints of hazards mean, and that they mean nothing where the robot does not say what it would hit. */
import type { BodyHeights } from '@farpoint/operator';
import { texts } from './language.ts';
import { fixed } from './numbers.ts';

/** What is tinted as a thing that the robot would hit, and as missing floor; or why nothing is. */
export type HazardWords =
  | { readonly hit: string; readonly drop: string; readonly unknown?: never }
  | { readonly unknown: string };

/** For the legend. @param heights `null`: the robot does not say */
export function hazardLegendWords(heights: BodyHeights | null): HazardWords {
  const said = texts().motion.hazards;
  if (heights === null) return { unknown: said.unknown };
  const { clearanceM, heightM, dropM } = heights;
  return { hit: said.hit(fixed(clearanceM, 2), fixed(heightM, 2)), drop: said.drop(fixed(dropM, 2)) };
}

/** What a key has done. */
export function hazardNotice(on: boolean, heights: BodyHeights | null): string {
  const said = texts().motion.hazards;
  if (!on) return said.off;
  return heights === null ? said.cannot : said.on;
}

/** For the wrist panel; `null`: nothing to say. */
export function hazardHint(on: boolean, heights: BodyHeights | null): string | null {
  if (!on) return null;
  const said = texts().motion.hazards;
  return heights === null ? said.hintUnknown : said.hint;
}
