import type { PulledMetrics } from '@farpoint/service';
import type { MeasuredRobot } from './measured-robot.ts';

/** Metrics of the broadcast. None if the robot does not have one. */
export function addBroadcastMetrics(
  metrics: PulledMetrics,
  { streams: { broadcast } }: Pick<MeasuredRobot, 'streams'>,
): void {
  if (broadcast === null) return;
  metrics.gauge('broadcast_up', '1 while the relay has the robot’s mountpoint', () => Number(broadcast.up));
  metrics.gauge('broadcast_viewers', 'Viewers at the relay', () => broadcast.viewers);
  metrics.sum(
    'broadcast_bytes',
    'Bytes sent to the relay on the wire, all headers counted',
    () => broadcast.bytesSent,
  );
  metrics.sum(
    'broadcast_mountpoints',
    'How often the mountpoint was created',
    () => broadcast.keeper.created,
  );
  metrics.sum(
    'broadcast_key_frame_requests',
    'Requests for key frames by the relay or for lost frames, including those that one key frame served together',
    () => broadcast.keyFrames.requests,
  );
  metrics.sum(
    'broadcast_failures',
    'Datagrams to the present mountpoint that could not be sent',
    () => broadcast.failures,
  );
}
