/** The simulated robot's floor cameras: what its guard knows of the floor at its wheels. */
import { type Twist, zeroTwist } from '@farpoint/protocol';
import { Footprint, ObstacleGuard } from '@farpoint/safety';
import { DEFAULT_LIMITS, officeWorld, SimulatedBase, THING_SIZE } from '@farpoint/sim';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { expect, test } from 'vitest';
import { guardedSensors, type ObstacleGuardConfiguration } from '../../motion/obstacles/guarded-sensors.ts';
import { makeSharedSnapshot, SnapshotWriter } from '../base/shared-snapshot.ts';
import { SimSource } from '../sources/sim-source.ts';
import { SensorGuard } from './sensor-guard.ts';

const SIZE = 240;
const CONFIGURATION: ObstacleGuardConfiguration = {
  ...{ mode: 'auto', footprint: [], brakes: { linear: 2, angular: 3 } },
  ...{ clearanceM: 0.04, heightM: 1.1, dropM: 0.15, marginM: 0.15, unseenMps: 0.3, blankIsMissing: true },
};
const NOW_MS = 1000;

interface Thing {
  ahead: number;
  left: number;
  height: number;
}

/** The guard of a robot that has just been started, after one look of its sensors. */
async function atTheStart(floorCameras: boolean, things: readonly Thing[] = []) {
  const codec = await loadCodecFromDisk();
  const base = new SimulatedBase(officeWorld());
  const snapshot = makeSharedSnapshot(officeWorld().movers.length);
  new SnapshotWriter(snapshot).write(base.snapshot);
  const source = { kind: 'sim' as const, seed: 1, size: SIZE, snapshot, things, floorCameras };
  const capture = {
    ...{
      framesPerSecond: 20,
      plan: 'paper' as const,
      floorFraction: 0.1,
      mostPoints: 1e6,
      sensor: 0,
      source,
    },
    sampling: { lambda: 3, epsilon: 1e-6, nearDistance: 3.85 },
  };
  const { sensors, grids } = guardedSensors(
    [{ name: 'Camera', priority: 0, weight: 1, capture }],
    CONFIGURATION,
  );
  const camera = await SimSource.create(source);
  using judge = await SensorGuard.open(codec, source, camera.description, sensors[0]!.capture.guard!);
  judge.take(camera.capture(NOW_MS));
  // Each in turn.
  for (let nowMs = NOW_MS - 100; nowMs <= NOW_MS; nowMs += 50) judge.lookDown(nowMs, true);
  camera.close();
  const guard = new ObstacleGuard(Footprint.disc(DEFAULT_LIMITS.radius), grids.length);
  const { pose, yaw, twist } = base.state;
  guard.moved({ x: pose.position.x, y: pose.position.y, yaw }, twist, NOW_MS);
  for (const [i, { reader }] of grids.entries()) {
    const grid = reader.read();
    if (grid !== null) guard.see(i, grid);
  }
  return guard;
}

const wish = (x: number, turn = 0): Twist => ({
  ...zeroTwist(),
  linear: { x, y: 0, z: 0 },
  angular: { x: 0, y: 0, z: turn },
});

test('with them, it sets off at full speed, on a curve, on the spot, and backwards', async () => {
  const guard = await atTheStart(true);
  for (const each of [wish(1), wish(1, 0.8), wish(1, -0.8), wish(0, 1.5), wish(-0.5)])
    expect([each, guard.bound(each, NOW_MS)]).toEqual([each, { factor: 1, reason: null, urgent: false }]);
});

test('without them, it does not see the floor before its wheels, and is slow', async () => {
  const guard = await atTheStart(false);
  for (const each of [wish(1), wish(-0.5)])
    expect(guard.bound(each, NOW_MS)).toMatchObject({ reason: 'unseen-space' });
});

test.each([0.07, 0.3])(
  'a thing %s m high before its wheels, too near for the depth camera, is seen',
  async (height) => {
    const things = [{ ahead: DEFAULT_LIMITS.radius + 0.2 + THING_SIZE / 2, left: 0, height }];
    const guard = await atTheStart(true, things);
    const { factor, reason } = guard.bound(wish(1), NOW_MS);
    expect(factor).toBeLessThan(0.1);
    expect(reason).toMatch(/^obstacle/);
    expect(guard.bound(wish(-0.5), NOW_MS).factor).toBe(1);
  },
);
