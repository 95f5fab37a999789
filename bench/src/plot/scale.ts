/** Maps values to pixels, and chooses round numbers for ticks. */

export interface Scale {
  readonly low: number;
  readonly high: number;
  pixel(value: number): number;
  ticks(): number[];
}

/** Maps `low`–`high` to `from`–`to` pixels. The range is widened to round numbers unless `exact`. */
export function linearScale(
  range: readonly [number, number],
  pixels: readonly [number, number],
  wantedTicks: number,
  exact = false,
): Scale {
  let [low, high] = range;
  if (!(high > low)) high = low + 1;
  const step = roundStep((high - low) / wantedTicks);
  if (!exact) {
    low = Math.floor(low / step + 1e-9) * step;
    high = Math.ceil(high / step - 1e-9) * step;
  }
  const [from, to] = pixels;
  return {
    low,
    high,
    pixel: (value) => from + ((value - low) / (high - low)) * (to - from),
    ticks: () => {
      const first = Math.ceil(low / step - 1e-9);
      const count = Math.floor(high / step + 1e-9) - first + 1;
      // Products rather than sums, so that rounding errors do not accumulate.
      return Array.from({ length: count }, (_, i) => Number(((first + i) * step).toPrecision(12)));
    },
  };
}

/** The smallest number that is 1, 2 or 5 times a power of ten and at least `least`. */
export function roundStep(least: number): number {
  const power = 10 ** Math.floor(Math.log10(least));
  const factor = [1, 2, 5, 10].find((candidate) => candidate * power >= least * (1 - 1e-9)) ?? 10;
  return factor * power;
}

/** Short labels for an axis: 1200 → `1.2k`. */
export function tickLabel(value: number): string {
  const magnitude = Math.abs(value);
  if (magnitude >= 1e6) return `${Number((value / 1e6).toPrecision(4))}M`;
  if (magnitude >= 1e4) return `${Number((value / 1e3).toPrecision(4))}k`;
  return String(Number(value.toPrecision(6)));
}
