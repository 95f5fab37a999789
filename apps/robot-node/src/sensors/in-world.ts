import type { BaseThread } from '../base/base-thread.ts';
import type { CloudSensorOptions } from './cloud-sensor.ts';

/** The simulator's sensors draw the base's world. */
export function inWorld(
  sensors: readonly CloudSensorOptions[],
  base: BaseThread | null,
): CloudSensorOptions[] {
  return sensors.map((sensor) => {
    const { source } = sensor.capture;
    if (base === null || (source.kind !== 'sim' && source.kind !== 'sim-lidar')) return sensor;
    return { ...sensor, capture: { ...sensor.capture, source: { ...source, snapshot: base.snapshot } } };
  });
}
