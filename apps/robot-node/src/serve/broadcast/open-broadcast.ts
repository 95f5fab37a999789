import type { VideoCodec } from '@farpoint/protocol';
import type { Logger } from '@farpoint/service';
import { monotonicMs } from '../../ground/clock.ts';
import type { Budgets } from '../../send/budgets/budgets.ts';
import type { CloudSensorOptions } from '../../send/clouds/cloud-sensor.ts';
import type { CloudSensors } from '../../send/clouds/cloud-sensors.ts';
import type { SendLoop } from '../../send/transport/send-loop.ts';
import type { VideoCamera } from '../../sense/video/video-encoder.ts';
import type { RobotCameras } from '../cameras/robot-cameras.ts';
import { Broadcast } from './broadcast.ts';
import type { BroadcastOptions } from './broadcast-options.ts';

/** @returns `null` if the robot is not to broadcast */
export function openBroadcast(
  {
    broadcast: options,
    name,
    sensors,
  }: { broadcast?: BroadcastOptions | undefined; name: string; sensors: readonly CloudSensorOptions[] },
  /** Read when they are needed: they may be made later. */
  robot: { readonly sensors: CloudSensors; readonly cameras: RobotCameras },
  {
    videos,
    sendLoop,
    budgets,
    log,
  }: { videos: readonly VideoCamera[]; sendLoop: SendLoop; budgets: Budgets; log: Logger },
): Broadcast | null {
  if (options === undefined) return null;
  const broadcast: Broadcast = new Broadcast({
    options,
    name,
    sensors,
    sendLoop,
    now: monotonicMs,
    log: log.child({ part: 'broadcast' }),
    // A mountpoint's codecs are fixed: it takes those that the cameras prefer.
    codecs: videos.map(({ codecs }) => codecs[0] as VideoCodec),
    claims: () => robot.sensors.claims,
    videos: () => robot.cameras.videos.descriptions,
    mostVideoBitsPerSecond: (video, codecs) => robot.cameras.videos.mostBitsPerSecond(video, codecs),
    requestKeyFrame: (video) => robot.cameras.videos.requestKeyFrame(video),
    budgets,
    onStart: () => robot.sensors.announceTo(broadcast),
  });
  return broadcast;
}
