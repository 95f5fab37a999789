import { describe, expect, test } from 'vitest';
import { COLOUR_STOPS, colourAt, colourStops, type Rgb } from './colour-map.ts';

/** sRGB to Oklab, written from the definition's forward direction. */
function labOf(rgb: Rgb): [number, number, number] {
  const [r, g, b] = rgb.map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)) as [
    number,
    number,
    number,
  ];
  const l = Math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const m = Math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const s = Math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return [
    0.2104542553 * l + 0.793617785 * m - 0.0040720468 * s,
    1.9779984951 * l - 2.428592205 * m + 0.4505937099 * s,
    0.0259040371 * l + 0.7827717662 * m - 0.808675766 * s,
  ];
}

const levels = Array.from({ length: 65 }, (_, i) => i / 64);

describe('the colour map', () => {
  test('equal steps look equally large', () => {
    const labs = levels.map((level) => labOf(colourAt(level)));
    const steps = labs.slice(1).map((lab, i) => Math.hypot(...lab.map((v, c) => v - labs[i]![c]!)));
    const mean = steps.reduce((sum, step) => sum + step, 0) / steps.length;
    for (const step of steps) expect(Math.abs(step / mean - 1)).toBeLessThan(0.2);
  });

  test('lightness only rises, and by half of its scale', () => {
    const lightness = levels.map((level) => labOf(colourAt(level))[0]);
    for (const [i, value] of lightness.slice(1).entries()) expect(value).toBeGreaterThan(lightness[i]!);
    expect(lightness.at(-1)! - lightness[0]!).toBeGreaterThan(0.5);
  });

  test('goes from violet to yellow through colours that a screen can show', () => {
    expect(colourStops()).toHaveLength(COLOUR_STOPS);
    for (const value of colourStops().flat()) {
      expect(value).toBeGreaterThanOrEqual(0);
      expect(value).toBeLessThanOrEqual(1);
    }
    const [[r0, g0, b0], [r1, g1, b1]] = [colourAt(0), colourAt(1)];
    expect(b0).toBeGreaterThan(Math.max(r0, g0));
    expect(Math.min(r1, g1)).toBeGreaterThan(b1 + 0.2);
  });

  test('values outside the range have the colours of its ends', () => {
    expect(colourAt(-3)).toEqual(colourAt(0));
    expect(colourAt(7)).toEqual(colourAt(1));
  });
});
