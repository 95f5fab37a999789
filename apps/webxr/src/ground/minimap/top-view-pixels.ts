/** The remembered world from above as pixels: coloured by height, darker the longer ago it was seen. Allocates nothing. */
import { colourAt, MEMORY_OLD_S } from '@farpoint/cloud-view';
import { TOP_VIEW, type TopView } from '@farpoint/operator';

/**
 * Heights within which a robot's wheels roll, metres. Chosen: a step of the view and the noise of a floor;
 * only a colour depends on it.
 */
const FLOOR_M = 0.08;
const FLOOR = [58, 74, 88] as const;
/** What lies below the floor: the robot would fall. */
const DROP = [214, 72, 62] as const;
/** The height with the last colour, metres: what is higher is not on the map (remembered-world.ts). */
const TALL_M = 2;
/**
 * What of its brightness is left after {@link MEMORY_OLD_S}. Chosen by eye: a little brighter than in the cloud, because
 * the map is small.
 */
const OLD_BRIGHTNESS = 0.45;

/** Red, green and blue by height. */
const COLOURS = new Uint8Array(256 * 3);
for (let step = 1; step < 256; step++) {
  const metres = TOP_VIEW.lowestM + (step - 1) * TOP_VIEW.stepM;
  const raised = colourAt(metres / TALL_M).map((part) => Math.round(part * 255));
  COLOURS.set(Math.abs(metres) <= FLOOR_M ? FLOOR : metres < 0 ? DROP : raised, step * 3);
}
/** By age. */
const BRIGHTNESS = Float32Array.from({ length: 256 }, (_, age) => {
  const share = Math.min((age * TOP_VIEW.ageUnitS) / MEMORY_OLD_S, 1);
  return 1 - (1 - OLD_BRIGHTNESS) * share;
});

/**
 * @param pixels gets the view: red, green, blue and opacity of each cell, rows from the greatest y on, as pictures have
 * them; transparent where nothing is remembered
 */
export function writeTopView(
  { heights, ages }: Pick<TopView, 'heights' | 'ages'>,
  pixels: Uint8ClampedArray,
): void {
  const { cells } = TOP_VIEW;
  for (let row = 0; row < cells; row++) {
    const from = (cells - 1 - row) * cells;
    for (let column = 0; column < cells; column++) {
      const height = heights[from + column] as number;
      const brightness = BRIGHTNESS[ages[from + column] as number] as number;
      const at = (row * cells + column) * 4;
      pixels[at] = (COLOURS[height * 3] as number) * brightness;
      pixels[at + 1] = (COLOURS[height * 3 + 1] as number) * brightness;
      pixels[at + 2] = (COLOURS[height * 3 + 2] as number) * brightness;
      pixels[at + 3] = height === 0 ? 0 : 255;
    }
  }
}
