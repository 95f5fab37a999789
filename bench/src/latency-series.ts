/** Latency over time, averaged as the telemetry thesis does, which published its measurements so. */
import type { Presented } from './presentation-figures.ts';

/** Width of each average, s. */
export const AVERAGED_S = 5;

/** Averages of one camera's latency. */
export interface LatencySeries {
  /** Middle of each average, s from the first presentation. */
  s: number[];
  /** From capture to the end of the display frame, ms; NaN where no picture was shown. */
  ms: number[];
}

/** @returns one series by camera; pictures count once, when they were first shown */
export function latencySeries(rows: readonly Omit<Presented, 'cloudMs'>[], cameras: number): LatencySeries[] {
  const whole = rows.filter((row): row is Presented & { finishedMs: number } => row.finishedMs !== null);
  const first = whole[0]?.finishedMs ?? 0;
  const bins = Math.floor(((whole.at(-1)?.finishedMs ?? first) - first) / 1000 / AVERAGED_S);
  return Array.from({ length: cameras }, (_, camera) => {
    const sums = Array.from({ length: bins }, () => ({ ms: 0, pictures: 0 }));
    let last: number | null = null;
    for (const { finishedMs, drawnMs } of whole) {
      const drawn = drawnMs[camera] ?? null;
      if (drawn === null || drawn === last) continue;
      last = drawn;
      const bin = sums[Math.floor((finishedMs - first) / 1000 / AVERAGED_S)];
      if (bin === undefined) continue;
      bin.ms += finishedMs - drawn;
      bin.pictures++;
    }
    return {
      s: sums.map((_, bin) => (bin + 0.5) * AVERAGED_S),
      ms: sums.map(({ ms, pictures }) => ms / pictures),
    };
  });
}
