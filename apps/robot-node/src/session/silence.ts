/** What a robot does about an operator of whom nothing is heard, by how long it has been so. */
export interface SilenceLimits {
  /** From here on points would only fill a path that does not carry them, ms. */
  streamMs: number;
  /** The line to signaling may be dead with it: ask, ms. */
  signalingMs: number;
  /** Whoever is away for this long does not drive, ms. */
  leaseMs: number;
  /** Gone, ms. */
  sessionMs: number;
}

export type SilenceStep = 'none' | 'check-signaling' | 'release-lease' | 'end';

/** @param sessionMs after which the session ends; nothing before it comes later */
export function silenceLimits(sessionMs: number): SilenceLimits {
  const least = (ms: number) => Math.min(ms, sessionMs);
  return { streamMs: least(2000), signalingMs: least(1000), leaseMs: least(5000), sessionMs };
}

/** The gravest step due. */
export function silenceStep(silentMs: number, limits: SilenceLimits): SilenceStep {
  if (silentMs > limits.sessionMs) return 'end';
  if (silentMs > limits.leaseMs) return 'release-lease';
  if (silentMs > limits.signalingMs) return 'check-signaling';
  return 'none';
}
