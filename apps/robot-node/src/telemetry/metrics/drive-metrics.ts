import type { PulledMetrics } from '@farpoint/service';
import type { Robot } from '../../robot.ts';

/** Metrics of commands and the guard's verdicts. */
export function addDriveMetrics(metrics: PulledMetrics, { counters, base }: Robot): void {
  metrics.sum('commands_accepted', 'Drive commands accepted', () => counters.commandsAccepted);
  metrics.sums('commands_rejected', 'Drive commands refused, by reason', 'reason', () =>
    counters.commandsRejected.entries(),
  );
  metrics.sum(
    'watchdog_thread_stops',
    'Stops by the simulated base’s own watchdog',
    () => base?.watchdogStops ?? 0,
  );
}
