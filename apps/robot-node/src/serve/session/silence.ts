/** How long an operator may be silent before the robot takes each step. */
export interface SilenceLimits {
  /** Stop sending points, which would only fill a path that does not deliver them, ms. */
  streamMs: number;
  /** Check the signaling connection, which may have failed together with the path, ms. */
  signalingMs: number;
  /**
   * Release the drive lease, ms. Only the page's own messages count: ICE and RTCP go on while a page is frozen, and
   * a page that does not run cannot drive.
   */
  leaseMs: number;
  /** End the session, ms. */
  sessionMs: number;
}

export type SilenceStep = 'none' | 'check-signaling' | 'end';

/**
 * @param sessionMs silence after which the session ends, ms; no other step comes later than that
 * @param leaseMs silence of the page after which its lease is released, ms
 */
export function silenceLimits(sessionMs: number, leaseMs: number): SilenceLimits {
  const least = (ms: number) => Math.min(ms, sessionMs);
  return { streamMs: least(2000), signalingMs: least(1000), leaseMs: least(leaseMs), sessionMs };
}

/** The most severe step that is due for an operator from whom nothing at all is heard. */
export function silenceStep(silentMs: number, limits: SilenceLimits): SilenceStep {
  if (silentMs > limits.sessionMs) return 'end';
  if (silentMs > limits.signalingMs) return 'check-signaling';
  return 'none';
}
