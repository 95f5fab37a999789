import type { PulledMetrics } from '@farpoint/service';
import type { MeasuredRobot } from './measured-robot.ts';

/** Metrics of what the sensors captured, and what became of their points. */
export function addSensorMetrics(
  metrics: PulledMetrics,
  { counters, streams: { sensors } }: MeasuredRobot,
): void {
  metrics.sum('frames_captured', 'Clouds captured', () => counters.framesCaptured);
  metrics.sum(
    'frames_without_buffer',
    'Clouds not captured because no buffer was free',
    () => sensors.framesWithoutBuffer,
  );
  metrics.sum(
    'source_faults',
    'Temporary faults of the source: no producer, bad clouds',
    () => sensors.faults,
  );
  metrics.sum(
    'frames_stale',
    'Clouds dropped because they were too old when ready',
    () => counters.framesStale,
  );
  metrics.sum('points_sent_per_frame_sum', 'Points of all captured frames', () => counters.pointsCaptured);
  metrics.sums('points_rejected', 'Points not sent, by reason', 'reason', () =>
    counters.pointsRejected.entries(),
  );
  metrics.sums('stage_seconds', 'Time spent, by stage', 'stage', () => counters.stageSeconds.entries());
  metrics.gauge('points_per_frame', 'Points of the last frame', () => counters.lastPoints);
  metrics.gauge('valid_points', 'Valid points of the last raw cloud', () => counters.lastValidPoints);
  metrics.gauge(
    'frames_per_second_planned',
    'Frames a second that are planned now',
    () => counters.lastFramesPerSecond,
  );
}
