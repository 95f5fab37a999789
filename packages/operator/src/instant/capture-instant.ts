/**
 * Capture instants on the robot's monotonic clock, in ms. What arrives are stamps of 32 bits that wrap; which of the
 * instants with the same stamp is meant follows from a reference time near it.
 */
import { sequenceDelta32, VIDEO_CLOCK_RATE } from '@farpoint/protocol';

const VIDEO_TICKS_PER_MS = VIDEO_CLOCK_RATE / 1000;
const STAMP_TICKS_PER_MS = 1000;

/**
 * What was captured together has stamps that differ by at most this, µs. A video's stamp counts in 1/90 ms, a cloud's in
 * µs, and the fastest cameras capture every 8 ms.
 */
export const SAME_INSTANT_US = 500;

/** Whether a picture and a cloud were captured together. @param aUs capture stamps, µs modulo 2³² */
export function isSameInstant(aUs: number, bUs: number): boolean {
  return Math.abs(sequenceDelta32(aUs, bUs)) <= SAME_INSTANT_US;
}

/**
 * The capture instant of a video's frame. Frames with the same timestamp have the same instant, to the last bit.
 *
 * @param rtpTimestamp of the frame, modulo 2³²
 * @param nearMs the robot's clock, known to within 6 hours
 */
export function captureMsOfRtp(rtpTimestamp: number, nearMs: number): number {
  return unwrapped(rtpTimestamp, nearMs, VIDEO_TICKS_PER_MS);
}

/**
 * The capture instant of a cloud.
 *
 * @param stampUs the cloud's `captureTimeUs`, modulo 2³²
 * @param nearMs the robot's clock, known to within half an hour
 */
export function captureMsOfStamp(stampUs: number, nearMs: number): number {
  return unwrapped(stampUs, nearMs, STAMP_TICKS_PER_MS);
}

function unwrapped(stamp: number, nearMs: number, ticksPerMs: number): number {
  const near = Math.floor(nearMs * ticksPerMs);
  // Beyond 2³², `>>>` would still take the lower 32 bits of the number, also of a negative one.
  return (near + sequenceDelta32(stamp, near >>> 0)) / ticksPerMs;
}
