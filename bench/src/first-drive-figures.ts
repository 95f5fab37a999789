/** What became of a drive, from the rows that the page records. */
import type { Intervention } from '@farpoint/protocol';
import type { DriveRecording, DriveRow } from '@farpoint/webxr/drive-record';
import { quantile } from './stats.ts';

/** What the obstacle guard and the like demand: right, whatever the computer. */
export const OF_GUARDS: ReadonlySet<Intervention> = new Set([
  'obstacle-near',
  'obstacle',
  'drop-off',
  'unseen-space',
  'sensor-silent',
  'collision-topic',
  'collision-silent',
  'fence-near',
  'fence',
]);

export interface DriveFigures {
  metres: number;
  /** The hand held a grip, s. */
  heldS: number;
  /** Of that, a guard of the robot's held or slowed it, s. */
  guardedS: number;
  /** Share of the rest in which the robot did what it was told. */
  obeyedShare: number;
  /** Age of what is on the screen, ms. */
  viewAgeMs: { p50: number; p95: number };
  gripsLost: number;
  refusals: number;
  /** Of the time in which it did not do what it was told: why, s. */
  whyNotS: Record<string, number>;
}

export function driveFigures({ rows, gripsLost, refusals }: DriveRecording): DriveFigures {
  let [metres, heldMs, guardedMs, obeyedMs] = [0, 0, 0, 0];
  const whyNotMs = new Map<string, number>();
  for (let i = 1; i < rows.length; i++) {
    const [before, row] = [rows[i - 1], rows[i]] as [DriveRow, DriveRow];
    metres += Math.hypot(row.x - before.x, row.y - before.y);
    if (!row.held) continue;
    const ms = row.atMs - before.atMs;
    heldMs += ms;
    const why = whyNot(row);
    if (why === 'guard') guardedMs += ms;
    else if (why === null) obeyedMs += ms;
    else whyNotMs.set(why, (whyNotMs.get(why) ?? 0) + ms);
  }
  const ages = Float64Array.from(rows.flatMap(({ seenMs }) => (seenMs === null ? [] : [seenMs]))).sort();
  const seconds = (ms: number) => Number((ms / 1000).toFixed(2));
  return {
    metres: Number(metres.toFixed(2)),
    heldS: seconds(heldMs),
    guardedS: seconds(guardedMs),
    obeyedShare: Number((obeyedMs / (heldMs - guardedMs)).toFixed(4)),
    viewAgeMs: { p50: Math.round(quantile(ages, 0.5)), p95: Math.round(quantile(ages, 0.95)) },
    gripsLost: gripsLost.length,
    refusals: refusals.length,
    whyNotS: Object.fromEntries([...whyNotMs].map(([why, ms]) => [why, seconds(ms)])),
  };
}

/** Up to this age of the view, blind travel bounds only turns at full speed, on the fastest computer too, ms. */
const FRESH_MS = 250;

/** Why the robot does not do what a hand that holds on tells it; `null` if it does. */
function whyNot({ reasons, factor, drive, paused, viewMs }: DriveRow): string | null {
  const isFresh = viewMs !== null && viewMs <= FRESH_MS;
  const other = reasons.find((reason) => !OF_GUARDS.has(reason) && !(reason === 'blind-travel' && isFresh));
  if (other !== undefined) return other;
  if (reasons.length > 0) return 'guard';
  if (paused) return 'grip-not-read';
  if (drive === 'blocked') return 'guard';
  return drive === 'driving' && factor === 1 ? null : drive;
}
