import type { PulledMetrics } from '@farpoint/service';
import type { ReturnStation } from '../../motion/return/return-station.ts';

/** Metrics of a robot that drives back by itself. */
export function addReturnMetrics(metrics: PulledMetrics, returns: ReturnStation): void {
  const { drive } = returns;
  metrics.gauge('return_active', '1 while the robot says that it drives back, or does, otherwise 0', () =>
    drive.isActive ? 1 : 0,
  );
  metrics.gauge('return_track_metres', 'Length of the way back that the robot knows', () => drive.trackM);
  metrics.sum('return_begun', 'Times that the robot has begun to drive back', () => returns.begun);
  metrics.sums('return_ended', 'Ends of the robot’s driving back, by reason', 'reason', () =>
    returns.ends.entries(),
  );
  metrics.sum('return_metres', 'Metres that the robot has driven back by itself', () => returns.metres);
}
