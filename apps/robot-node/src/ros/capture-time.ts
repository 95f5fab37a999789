/** When what a ROS message holds was captured, on the robot's clock. */

export interface RosClock {
  /** Robot’s clock, ms. */
  now(): number;
  /** Time of day, ns since 1970, as in stamps. */
  wallNs(): bigint;
}

/** An older stamp is from another clock, or from a picture that was delayed. The arrival time is then used, ms. */
const MOST_AGE_MS = 500;

/** The stamp's time if it is recent and on our clock, otherwise the arrival time; ms. */
export function capturedAtMs(clock: RosClock, stampNs: bigint, receivedMs: number): number {
  const nowMs = clock.now();
  const ageMs = Number(clock.wallNs() - stampNs) / 1e6;
  const stamped = ageMs >= 0 && ageMs <= MOST_AGE_MS;
  return stamped ? nowMs - ageMs : receivedMs;
}
