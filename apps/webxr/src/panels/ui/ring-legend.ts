/** The legend of a LiDAR's rings: each in its colour, side by side from the lowest to the highest. */
import { type Rgb, RING_COLOURS, type Rings, ringColours } from '@farpoint/cloud-view';
import type { Tick } from './colour-ticks.ts';

/** @param rings `null`: none are known or have been found */
export function ringCaption(rings: Rings | null): string {
  if (rings === null) return 'no rings found yet';
  return `${rings.elevations.length} rings${rings.from === 'points' ? ', estimated' : ''}`;
}

/** A CSS background. */
export function ringBar(count: number, cssOf: (colour: Rgb) => string): string {
  const end = (ring: number) => `${((ring / count) * 100).toFixed(2)}%`;
  const bands = Array.from({ length: count }, (_, ring) => {
    const colour = ringColours()[ring % RING_COLOURS] as Rgb;
    return `${cssOf(colour)} ${end(ring)} ${end(ring + 1)}`;
  });
  return count === 0 ? 'none' : `linear-gradient(90deg, ${bands.join()})`;
}

/** Between numbered rings; one of them is enough for 256 rings. */
const STEPS = [1, 2, 5, 10, 20, 50, 100];
const MOST_TICKS = 5;

/** Round numbers of rings, each below the middle of its ring. */
export function ringTicks(count: number): Tick[] {
  const step = STEPS.find((each) => count <= each * MOST_TICKS) ?? count;
  return Array.from({ length: Math.ceil(count / step) }, (_, i) => ({
    place: (i * step + 0.5) / count,
    text: String(i * step),
  }));
}
