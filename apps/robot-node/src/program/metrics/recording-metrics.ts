import type { PulledMetrics } from '@farpoint/service';
import type { MeasuredRobot } from './measured-robot.ts';

/** Metrics of the recording's size and of what was left out. None if nothing is recorded. */
export function addRecordingMetrics(
  metrics: PulledMetrics,
  { recording }: Pick<MeasuredRobot, 'recording'>,
): void {
  if (recording === null || !recording.hasFile) return;
  metrics.sum('recording_messages', 'Messages recorded', () => recording.counts.messages);
  metrics.sum('recording_bytes', 'Bytes of the recording', () => recording.counts.bytes);
  metrics.sums(
    'recording_dropped',
    'Items not recorded because the writer did not keep up, by kind',
    'kind',
    () => Object.entries(recording.counts.dropped),
  );
}
