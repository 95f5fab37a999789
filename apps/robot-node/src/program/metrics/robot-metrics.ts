import { PulledMetrics, type Registry } from '@farpoint/service';
import { addDriveMetrics, addGuardMetrics } from './drive-metrics.ts';
import type { MeasuredRobot } from './measured-robot.ts';
import { addPathMetrics, addSensorMetrics } from './path-metrics.ts';
import {
  addBroadcastMetrics,
  addReferenceMetrics,
  addSessionMetrics,
  addSignalingMetrics,
} from './session-metrics.ts';
import { addDeviceMetrics, addPictureMetrics, addSoundMetrics, addVideoMetrics } from './video-metrics.ts';

/** Metrics of the recording's size and of what was left out. None if nothing is recorded. */
function addRecordingMetrics(metrics: PulledMetrics, { recording }: MeasuredRobot['parts']): void {
  if (recording === null || !recording.hasFile) return;
  metrics.sum('recording_bytes', 'Bytes of the recording', () => recording.counts.bytes);
  metrics.sums(
    'recording_dropped',
    'Items not recorded because the writer did not keep up, by kind',
    'kind',
    () => Object.entries(recording.counts.dropped),
  );
}

/** Metrics of the server for Foxglove. None if there is none. */
function addLiveMetrics(metrics: PulledMetrics, { recording }: MeasuredRobot['parts']): void {
  if (recording === null || recording.live === null) return;
  const report = () => recording.live?.report ?? null;
  metrics.gauge('foxglove_clients', 'Viewers connected now', () => report()?.clients ?? 0);
  metrics.sum('foxglove_messages', 'Messages sent to viewers', () => report()?.messages ?? 0);
  metrics.sum('foxglove_bytes', 'Bytes of these messages', () => report()?.bytes ?? 0);
  metrics.sum(
    'foxglove_dropped',
    'Messages not sent because a viewer reads too slowly',
    () => report()?.dropped ?? 0,
  );
  metrics.sums(
    'foxglove_refused',
    'Messages and connections of viewers that were refused, by reason',
    'reason',
    () => [...Object.entries(report()?.refused ?? {}), ...Object.entries(report()?.connectionsRefused ?? {})],
  );
}

/** Metrics of the spans. None if no endpoint takes them. */
function addSpanMetrics(metrics: PulledMetrics, { spans }: Pick<MeasuredRobot, 'spans'>): void {
  if (spans === null) return;
  metrics.sums('spans', 'Spans of clouds and commands, by what became of them', 'outcome', () => [
    ...spans.outcomes.entries(),
    ['dropped', spans.traces.overwrittenSpans],
  ]);
}

/** Registers all of the robot's counts for `/metrics`. */
export function registerRobotMetrics(registry: Registry, robot: MeasuredRobot): void {
  const metrics = new PulledMetrics(registry, 'farpoint_robot');
  addSessionMetrics(metrics, robot);
  addSignalingMetrics(metrics, robot);
  addDriveMetrics(metrics, robot);
  addGuardMetrics(metrics, robot.parts);
  addSensorMetrics(metrics, robot);
  addPathMetrics(metrics, robot);
  addPictureMetrics(metrics, robot);
  addVideoMetrics(metrics, robot);
  addSoundMetrics(metrics, robot);
  addDeviceMetrics(metrics, robot);
  addBroadcastMetrics(metrics, robot);
  addRecordingMetrics(metrics, robot.parts);
  addLiveMetrics(metrics, robot.parts);
  addReferenceMetrics(metrics, robot);
  addSpanMetrics(metrics, robot);
}
