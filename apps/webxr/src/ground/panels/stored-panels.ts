/** The panels' places that this browser keeps. */
import * as z from 'zod/mini';
import { MOST_PLACEMENTS, type Placements } from './panel-placements.ts';

const KEY = 'farpoint.panels';
/** Bounds on what the browser has stored: more than any screen has, and than any name. */
const MOST_PIXELS = 16_384;
const MOST_NAME = 256;

const share = z.number().check(z.minimum(0), z.maximum(1));
const schema = z.object({
  panels: z
    .array(
      z.object({
        name: z.string().check(z.minLength(1), z.maxLength(MOST_NAME)),
        x: share,
        y: share,
        width: z.number().check(z.positive(), z.maximum(MOST_PIXELS)),
      }),
    )
    .check(z.maxLength(MOST_PLACEMENTS)),
});

/** Every panel is in its usual place if the text is not what {@link placementsText} writes. */
export function parsePlacements(text: string | null): Placements {
  let value: unknown = null;
  try {
    value = JSON.parse(text ?? 'null');
  } catch {
    return new Map();
  }
  const { success, data } = schema.safeParse(value);
  return new Map(success ? data.panels.map(({ name, ...placement }) => [name, placement]) : []);
}

/** What {@link parsePlacements} reads. */
export function placementsText(placements: Placements): string {
  return JSON.stringify({ panels: [...placements].map(([name, placement]) => ({ name, ...placement })) });
}

export function loadPlacements(): Placements {
  try {
    return parsePlacements(localStorage.getItem(KEY));
  } catch {
    return new Map();
  }
}

export function storePlacements(placements: Placements): void {
  try {
    localStorage.setItem(KEY, placementsText(placements));
  } catch {
    // Private browsing: panels stay where they are for this visit only.
  }
}
