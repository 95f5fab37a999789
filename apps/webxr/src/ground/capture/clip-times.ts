/** When each picture of a clip is shown, and how much is missing between them. Pure. */
import type { ClipPicture } from './clip-ring.ts';

/**
 * A longer time without a picture is missing, and is cut to this, µs: the page was hidden, or the machine could not keep up. Chosen:
 * a still picture for longer would look like a robot that stands; clip-times.test.ts holds it.
 */
const GAP_US = 1_000_000;

export interface ClipTimes {
  /** When each picture begins and for how long it is shown, seconds from the clip's beginning. */
  readonly shown: readonly { readonly atS: number; readonly forS: number }[];
  /** How long the clip is, and how much time in between it does not show, seconds. */
  readonly seconds: number;
  readonly missingS: number;
}

/** @param usualUs how long the last picture is shown */
export function clipTimes(pictures: readonly Pick<ClipPicture, 'timestampUs'>[], usualUs: number): ClipTimes {
  const shown: { atS: number; forS: number }[] = [];
  let [atUs, missingUs] = [0, 0];
  for (const [i, { timestampUs }] of pictures.entries()) {
    const wholeUs = (pictures[i + 1]?.timestampUs ?? timestampUs + usualUs) - timestampUs;
    const forUs = Math.min(wholeUs, GAP_US);
    missingUs += wholeUs - forUs;
    shown.push({ atS: atUs / 1e6, forS: forUs / 1e6 });
    atUs += forUs;
  }
  return { shown, seconds: atUs / 1e6, missingS: missingUs / 1e6 };
}
