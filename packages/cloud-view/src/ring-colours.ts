/**
 * Colours for rings. Neighbours are far apart in lightness and in hue, so that they can be told apart by colour-blind
 * people, too; the same colour comes again after eight rings.
 */
import { type Rgb, rgbOfTint } from './colour-map.ts';

/**
 * Number of different colours. Chosen by eye: neighbours differ in hue and lightness, and after eight nobody
 * confuses two (docs/decisions/2026-11-23-rings-by-elevation.md).
 */
export const RING_COLOURS = 8;

/** Lightness of rings with even and with odd numbers. */
const LIGHTNESS = [0.86, 0.58] as const;
/** Degrees from one ring to the next: no multiple of it below eight comes back to a hue. */
const HUE_STEP = 135;
const FIRST_HUE = 105;

let colours: readonly Rgb[] | null = null;

/** Ring n has colour n modulo {@link RING_COLOURS}. */
export function ringColours(): readonly Rgb[] {
  colours ??= Array.from({ length: RING_COLOURS }, (_, i) =>
    rgbOfTint({ lightness: LIGHTNESS[i % 2] as number, hue: FIRST_HUE + HUE_STEP * i }),
  );
  return colours;
}
