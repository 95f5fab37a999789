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

/** Metrics of the server for Foxglove. None if there is none. */
export function addLiveMetrics(
  metrics: PulledMetrics,
  { recording }: Pick<MeasuredRobot, 'recording'>,
): void {
  if (recording === null || recording.live === null) return;
  const report = () => recording.live?.report ?? null;
  metrics.gauge('foxglove_listening', 'Whether viewers can connect', () => Number(recording.live?.listening));
  metrics.gauge('foxglove_clients', 'Viewers connected now', () => report()?.clients ?? 0);
  metrics.gauge(
    'foxglove_subscriptions',
    'Channels that viewers subscribe to now, counted for each viewer',
    () => report()?.subscriptions ?? 0,
  );
  metrics.sum('foxglove_messages', 'Messages sent to viewers', () => report()?.messages ?? 0);
  metrics.sum('foxglove_bytes', 'Bytes of these messages', () => report()?.bytes ?? 0);
  metrics.sum(
    'foxglove_dropped',
    'Messages not sent because a viewer reads too slowly',
    () => report()?.dropped ?? 0,
  );
  metrics.sums('foxglove_refused', 'Messages of viewers that were not obeyed, by reason', 'reason', () =>
    Object.entries(report()?.refused ?? {}),
  );
  metrics.sums('foxglove_connections_refused', 'Connections refused, by reason', 'reason', () =>
    Object.entries(report()?.connectionsRefused ?? {}),
  );
}
