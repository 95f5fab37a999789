import type { Rgb } from './stage.ts';

/** Share of pixels that differ in a channel by more than this many levels, 0–1. */
export function changedShare(before: readonly Rgb[], after: readonly Rgb[], levels = 10): number {
  if (before.length !== after.length) throw new Error('the pictures differ in size');
  const changed = before.filter((pixel, i) =>
    pixel.some((level, channel) => Math.abs(level - (after[i]?.[channel] ?? 0)) > levels),
  );
  return changed.length / before.length;
}

/** The smallest box around the pixels for which something holds, pixels; `null` if it holds for none. */
export function boxOf(
  pixels: readonly Rgb[],
  columns: number,
  is: (pixel: Rgb) => boolean,
): { left: number; top: number; width: number; height: number } | null {
  const places = pixels.flatMap((pixel, i) => (is(pixel) ? [[i % columns, Math.floor(i / columns)]] : []));
  if (places.length === 0) return null;
  const [x, y] = [places.map(([column]) => column as number), places.map(([, row]) => row as number)];
  const [left, top] = [Math.min(...x), Math.min(...y)];
  return { left, top, width: Math.max(...x) - left + 1, height: Math.max(...y) - top + 1 };
}
