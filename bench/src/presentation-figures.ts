/** What recorded presentations say about latency and spread: pure functions. */
import { type Distribution, distribution } from './stats.ts';

const ROUNDING_MS = 0.01;

/** One presentation: when its display frame ended, and the capture time in each camera's picture, ms, same clock. */
export interface Presented {
  finishedMs: number | null;
  drawnMs: readonly (number | null)[];
  /** When the newest cloud beside them was captured; `null` without one. */
  cloudMs: number | null;
}

export interface PresentationFigures {
  /** From capture to the end of the display frame that shows it, by camera; each picture counts once. */
  glassToGlassMs: Distribution[];
  /** Between the earliest and the latest capture in a presentation. */
  spreadMs: Distribution;
  /** Share of presentations with a spread of less than 1 ms, 0–1. */
  share1Ms: number;
  /** The same of no more than half an interval of the slowest camera. */
  shareHalfInterval: number;
  /** Between the newest capture of the cameras and that of the cloud beside them. */
  cloudApartMs: Distribution;
  /** Share of presentations in which that is no more than half an interval of the slowest stream, 0–1. */
  cloudHalfInterval: number;
  framesPerSecond: number[];
  /** Pictures whose barcode could not be read. */
  unreadable: number;
}

/** @param framesPerS of each camera, as asked @param cloudsPerS as asked */
export function presentationFigures(
  rows: readonly Presented[],
  framesPerS: readonly number[],
  cloudsPerS: number,
): PresentationFigures {
  const cameras = framesPerS.length;
  const whole = rows.filter(({ finishedMs }) => finishedMs !== null);
  const spreads = whole.flatMap(({ drawnMs }) => {
    const times = drawnMs.filter((time) => time !== null);
    return times.length < cameras || cameras < 2 ? [] : [Math.max(...times) - Math.min(...times)];
  });
  const clouds = whole.flatMap(({ drawnMs, cloudMs }) => {
    const newestMs = Math.max(...drawnMs.filter((time) => time !== null));
    return cloudMs === null || !Number.isFinite(newestMs) ? [] : [Math.abs(newestMs - cloudMs)];
  });
  const withinHalfInterval = (apartMs: readonly number[], perS: number) =>
    // Times in a barcode are rounded.
    share(apartMs, (apart) => apart < 500 / perS + ROUNDING_MS);
  const first = whole[0]?.finishedMs ?? 0;
  const seconds = ((whole.at(-1)?.finishedMs ?? 0) - first) / 1000;
  const ages = Array.from({ length: cameras }, (_, camera) => agesOf(whole, camera));
  return {
    glassToGlassMs: ages.map((each) => distribution(each)),
    spreadMs: distribution(spreads),
    share1Ms: share(spreads, (spread) => spread < 1),
    shareHalfInterval: withinHalfInterval(spreads, Math.min(...framesPerS)),
    cloudApartMs: distribution(clouds),
    cloudHalfInterval: withinHalfInterval(clouds, Math.min(...framesPerS, cloudsPerS)),
    framesPerSecond: ages.map((each) => (seconds > 0 ? each.length / seconds : 0)),
    unreadable: whole.reduce((sum, { drawnMs }) => sum + drawnMs.filter((time) => time === null).length, 0),
  };
}

function share(values: readonly number[], is: (value: number) => boolean): number {
  return values.length === 0 ? 1 : values.filter(is).length / values.length;
}

function agesOf(rows: readonly Presented[], camera: number): number[] {
  const ages: number[] = [];
  let last: number | null = null;
  for (const { finishedMs, drawnMs } of rows) {
    const drawn = drawnMs[camera] ?? null;
    if (drawn === null || drawn === last || finishedMs === null) continue;
    last = drawn;
    ages.push(finishedMs - drawn);
  }
  return ages;
}
