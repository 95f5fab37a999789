/** How long an operator may be silent before the robot takes each step. */
export interface SilenceLimits {
  /** Stop sending points, which would only fill a path that does not deliver them, ms. */
  streamMs: number;
  /** Check the signaling connection, which may have failed together with the path, ms. */
  signalingMs: number;
  /** Release the drive lease, ms. */
  leaseMs: number;
  /** End the session, ms. */
  sessionMs: number;
}

export type SilenceStep = 'none' | 'check-signaling' | 'release-lease' | 'end';

/** @param sessionMs silence after which the session ends, ms; no other step comes later than that */
export function silenceLimits(sessionMs: number): SilenceLimits {
  const least = (ms: number) => Math.min(ms, sessionMs);
  return { streamMs: least(2000), signalingMs: least(1000), leaseMs: least(5000), sessionMs };
}

/** The most severe step that is due. */
export function silenceStep(silentMs: number, limits: SilenceLimits): SilenceStep {
  if (silentMs > limits.sessionMs) return 'end';
  if (silentMs > limits.leaseMs) return 'release-lease';
  if (silentMs > limits.signalingMs) return 'check-signaling';
  return 'none';
}
