import type { PulledMetrics } from '@farpoint/service';
import type { MeasuredRobot } from './measured-robot.ts';

/** Metrics of the connection to the signaling service. */
export function addSignalingMetrics(metrics: PulledMetrics, { counters, signaling }: MeasuredRobot): void {
  metrics.sums('signaling_errors', 'Errors reported by signaling, by code', 'code', () =>
    counters.signalingErrors.entries(),
  );
  metrics.sum('signaling_disconnects', 'Lost connections to signaling', () => signaling.disconnects);
  metrics.sum('signaling_malformed', 'Unreadable messages from signaling', () => signaling.malformed);
  metrics.gauge('signaling_registered', '1 while registered with the signaling service', () =>
    Number(signaling.registered),
  );
}
