/** The real capture thread, which judges clouds for the obstacle guard. */
import { zeroTwist } from '@farpoint/protocol';
import { Footprint } from '@farpoint/safety';
import { afterEach, expect, it } from 'vitest';
import { monotonicMs } from '../../ground/clock.ts';
import type { CloudSensorOptions } from '../../send/clouds/cloud-sensor.ts';
import { Capture } from '../../sense/capture/capture.ts';
import type { CaptureOptions } from '../../sense/capture/capture-messages.ts';
import { opticalMount } from '../../sense/sources/sensor-mount.ts';
import { guardedSensors, type ObstacleGuardConfiguration } from './guarded-sensors.ts';
import { ObstacleStation } from './obstacle-station.ts';

const CONFIGURATION: ObstacleGuardConfiguration = {
  ...{ mode: 'auto', footprint: Footprint.disc(0.25).corners },
  brakes: { linear: 2, angular: 3 },
  ...{ clearanceM: 0.04, heightM: 1.1, dropM: 0.15, marginM: 0.1, unseenMps: 0.3 },
};
const CAPTURE: Omit<CaptureOptions, 'sensor' | 'source'> = {
  ...{ framesPerSecond: 60, plan: 'paper', floorFraction: 0.1, mostPoints: 1_000_000 },
  sampling: { lambda: 3, epsilon: 1e-6, nearDistance: 3.85 },
};
const SENSORS: CloudSensorOptions[] = [
  { kind: 'sim' as const, seed: 1, size: 240 },
  { kind: 'sim-lidar' as const, seed: 1 },
].map((source, sensor) => {
  return { name: source.kind, priority: 0, weight: 1, capture: { ...CAPTURE, sensor, source } };
});

const open: Capture[] = [];
afterEach(async () => {
  for (const capture of open.splice(0)) await capture.close();
});

it('clouds of every sensor are judged while somebody drives, although nobody watches', async () => {
  const { sensors, grids } = guardedSensors(SENSORS, CONFIGURATION);
  for (const { capture } of sensors) open.push(await Capture.start(capture));
  const frames: unknown[] = [];
  for (const capture of open) capture.onFrame = (frame) => frames.push(frame);
  const station = new ObstacleStation({ configuration: CONFIGURATION, grids, captures: open });
  const wish = zeroTwist();
  wish.linear.x = 1;
  expect(station.state(monotonicMs())).toBe('blind');
  expect(station.bound(wish, monotonicMs())).toMatchObject({ factor: 0.3, urgent: false });

  const nothing = { newest: null, jumps: { count: 0, lastMs: Number.NEGATIVE_INFINITY } };
  station.update(nothing, true);
  // Odometry comes as well, as from a robot that stands at the start.
  const pose = { x: 3, y: 6, yaw: 0 };
  const silent = () => station.bound(wish, monotonicMs()).reason === 'sensor-silent';
  await expect
    .poll(
      () => {
        const timeMs = monotonicMs();
        station.update({ ...nothing, newest: { pose, twist: zeroTwist(), measuredMs: timeMs } }, true);
        return [station.state(timeMs), silent()];
      },
      { timeout: 10_000 },
    )
    .toEqual(['on', false]);
  expect(frames).toEqual([]);

  station.update(nothing, false);
  await expect.poll(() => station.state(monotonicMs()), { timeout: 5000 }).toBe('blind');
}, 30_000);

it('a robot whose sensor sits nobody knows where has no guard, and bounds nothing', async () => {
  const source = { kind: 'pcd' as const, path: 'a.pcd', frame: 'auto' as const };
  const unknown = [{ ...SENSORS[0]!, capture: { ...CAPTURE, sensor: 0, source } }];
  const { grids, sensors } = guardedSensors(unknown, CONFIGURATION);
  expect([grids, sensors[0]?.capture.guard]).toEqual([[], undefined]);
  const station = new ObstacleStation({ configuration: CONFIGURATION, grids, captures: [] });
  expect(station.state(0)).toBe('off');
  expect(station.bound({ ...zeroTwist(), linear: { x: 1, y: 0, z: 0 } }, 0).factor).toBe(1);
  const mount = opticalMount({ x: 0, y: 0, z: 1, roll: 0, pitch: 0, yaw: 0 });
  const known = [{ ...SENSORS[0]!, capture: { ...CAPTURE, sensor: 0, source: { ...source, mount } } }];
  expect(guardedSensors(known, CONFIGURATION).grids.length).toBe(1);
  expect(guardedSensors(SENSORS, { ...CONFIGURATION, mode: 'off' }).grids).toEqual([]);
});
