/** Estimates how fast a recording grows, to announce it before it fills a disk. */
import { BitRate } from '@farpoint/timing';

/** A point of a recorded cloud: x, y, z and colour, four bytes each. */
const POINT_BYTES = 16;
/**
 * Poses, velocities, telemetry, estimates and latencies while somebody drives. Chosen: above 20 messages of
 * telemetry and 40 commands a second.
 */
const EVENT_BYTES_PER_SECOND = 50_000;
/** The most that pictures may take of any link, 3 Mbit/s (picture-plan.ts). */
const PICTURE_BYTES_PER_SECOND = BitRate.toBytesPerSecond(BitRate.fromMbps(3));

export interface RecordedKinds {
  /** Highest number of clouds recorded per second; 0 records none. */
  perSecond: Readonly<Record<'captured' | 'sent', number>>;
  /** Maximum number of points in a cloud. */
  points: number;
  /** The source's highest frame rate, frames/s. */
  framesPerSecond: number;
  pictures: boolean;
  /** Of all recorded videos, at most. */
  videoBitsPerSecond: number;
}

/** Upper limit of bytes per second while an operator watches, without compression. */
export function recordingBytesPerSecond({
  perSecond,
  points,
  framesPerSecond,
  pictures,
  videoBitsPerSecond,
}: RecordedKinds): number {
  const clouds = Math.min(perSecond.captured, framesPerSecond) + Math.min(perSecond.sent, framesPerSecond);
  return (
    clouds * points * POINT_BYTES +
    EVENT_BYTES_PER_SECOND +
    (pictures ? PICTURE_BYTES_PER_SECOND : 0) +
    BitRate.toBytesPerSecond(videoBitsPerSecond)
  );
}

/** E.g. `446 MB`, `1.2 GB`. */
export function sizeWords(bytes: number): string {
  const [value, unit] =
    bytes >= 1e9 ? [bytes / 1e9, 'GB'] : bytes >= 1e6 ? [bytes / 1e6, 'MB'] : [bytes / 1e3, 'kB'];
  return `${value >= 10 ? value.toFixed(0) : value.toFixed(1).replace(/\.0$/, '')} ${unit}`;
}

/** E.g. `40 s`, `12 min`, `3 h`. */
export function durationWords(seconds: number): string {
  if (seconds < 120) return `${Math.floor(seconds)} s`;
  return seconds < 7200 ? `${Math.floor(seconds / 60)} min` : `${Math.floor(seconds / 3600)} h`;
}
