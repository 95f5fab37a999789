import type { PulledMetrics } from '@farpoint/service';
import type { Robot } from '../../robot.ts';

/** The line to the signaling service. */
export function addSignalingMetrics(metrics: PulledMetrics, { counters, signaling }: Robot): void {
  metrics.sums('signaling_errors', 'Errors that the signaling service reported, by code', 'code', () =>
    counters.signalingErrors.entries(),
  );
  metrics.sum(
    'signaling_disconnects',
    'Times the line to the signaling service broke',
    () => signaling.disconnects,
  );
  metrics.sum(
    'signaling_malformed',
    'Messages of the signaling service that could not be read',
    () => signaling.malformed,
  );
  metrics.gauge('signaling_registered', '1 while registered with the signaling service', () =>
    Number(signaling.registered),
  );
}
