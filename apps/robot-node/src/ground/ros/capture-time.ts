/** When what a ROS message holds was captured, on the robot's clock. */

import { RosFault } from '@farpoint/ros';
import { readAtOnce } from '../clock.ts';

export interface RosClock {
  /** Robot’s clock, ms. */
  now(): number;
  /** Time of day, ns since 1970, as in stamps. */
  wallNs(): bigint;
}

/**
 * Stamps that lie farther back are of another clock, ms. Chosen: no message waits for a day, and clocks that
 * were never set or simulate are off by years.
 */
export const FOREIGN_AGE_MS = 24 * 3600 * 1000;

/**
 * Both clocks are read at once if no more time passes between two readings, ms. Chosen: reading both takes
 * some microseconds, and stamps of ROS need no more.
 */
const AT_ONCE_MS = 0.02;

/** When what a ROS message holds was captured: on the robot's clock, ms. */
export type CaptureTime = (stampNs: bigint, receivedMs: number) => number;

/**
 * Of what is only shown, as pictures are: the stamp's time, however old it is; where it lies in the future, or more than a
 * day back, the arrival, ms. Messages of one stamp, a cloud and a picture for example, are of one instant, whenever they
 * arrive. `StampClock` judges what the robot's safety rests on.
 */
export function capturedAtMs(clock: RosClock, stampNs: bigint, receivedMs: number): number {
  const { nowMs, wallNs } = readBoth(clock);
  const ageMs = Number(wallNs - stampNs) / 1e6;
  const stamped = ageMs >= 0 && ageMs <= FOREIGN_AGE_MS;
  return stamped ? nowMs - ageMs : receivedMs;
}

/** Both clocks of one instant. */
export function readBoth(clock: RosClock): { nowMs: number; wallNs: bigint } {
  const { beforeMs, afterMs, time } = readAtOnce(
    () => clock.now(),
    () => clock.wallNs(),
    AT_ONCE_MS,
  );
  return { nowMs: (beforeMs + afterMs) / 2, wallNs: time };
}

/**
 * Messages that are older when they come are late, or of a clock that is behind, ms. Chosen: as old as a
 * cloud whose stamp is refused (stamp-clock.ts); nothing is driven by it.
 */
export const LATE_MS = 1000;

/** That a topic's messages are older than that. */
export function lateFault(topic: string): RosFault {
  return new RosFault('bad-message', 'its messages are more than a second old when they come', {
    topic,
    remedy: 'they are late, or the publisher’s clock is behind: keep both clocks in step',
  });
}
