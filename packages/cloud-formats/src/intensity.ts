/**
 * LiDAR intensity as colour: from dark blue through green to yellow, with uniform brightness steps (after viridis, five
 * stops).
 */
const STOPS: readonly (readonly [number, number, number])[] = [
  [68, 1, 84],
  [59, 82, 139],
  [33, 145, 140],
  [94, 201, 98],
  [253, 231, 37],
];

/**
 * @param level 0–1, clamped
 * @returns R in the lowest byte, then G, B and 255
 */
export function intensityColour(level: number): number {
  const at = (Number.isFinite(level) ? Math.min(Math.max(level, 0), 1) : 0) * (STOPS.length - 1);
  const low = STOPS[Math.min(Math.floor(at), STOPS.length - 2)] as readonly [number, number, number];
  const high = STOPS[Math.min(Math.floor(at), STOPS.length - 2) + 1] as readonly [number, number, number];
  const part = at - Math.min(Math.floor(at), STOPS.length - 2);
  const mix = (channel: 0 | 1 | 2) => Math.round(low[channel] + (high[channel] - low[channel]) * part);
  return (mix(0) | (mix(1) << 8) | (mix(2) << 16) | 0xff00_0000) >>> 0;
}

/**
 * Factor that scales all but the brightest hundredth of the intensities to 0–1. Sensors differ in their scale, and a
 * few reflectors would leave everything else dark.
 */
export function intensityScale(value: (index: number) => number, count: number): number {
  const stride = Math.max(1, Math.floor(count / 4096));
  const samples: number[] = [];
  for (let i = 0; i < count; i += stride) {
    const sample = value(i);
    if (Number.isFinite(sample) && sample > 0) samples.push(sample);
  }
  samples.sort((a, b) => a - b);
  const bright = samples[Math.floor(samples.length * 0.99)] ?? samples.at(-1);
  return bright === undefined ? 0 : 1 / bright;
}
