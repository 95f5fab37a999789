import type { CloudSensorOptions } from '../send/clouds/cloud-sensor.ts';
import type { BaseThread } from '../sense/base/base-thread.ts';
import type { VideoCameraOptions } from '../serve/cameras/open-video-cameras.ts';

/** Gives simulated sensors the world of the simulated base, so that they see the robot move. */
export function inWorld(
  sensors: readonly CloudSensorOptions[],
  base: BaseThread | null,
): CloudSensorOptions[] {
  return sensors.map((sensor) => {
    const { source } = sensor.capture;
    if (base === null || (source.kind !== 'sim' && source.kind !== 'sim-lidar')) return sensor;
    const { snapshot, things } = base;
    return { ...sensor, capture: { ...sensor.capture, source: { ...source, snapshot, things } } };
  });
}

/** The same for simulated cameras that are streamed as video. */
export function videosInWorld(
  cameras: readonly VideoCameraOptions[],
  base: BaseThread | null,
): VideoCameraOptions[] {
  return cameras.map((camera) => {
    const { source } = camera;
    if (base === null || source.kind !== 'sim') return camera;
    const { snapshot, things } = base;
    return { ...camera, source: { ...source, snapshot, things } };
  });
}
