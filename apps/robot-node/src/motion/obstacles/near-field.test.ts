/** What operators are told of a thing that has left the camera's view. */
import { Footprint, floorClasses, ObstacleGuard, type SensorGrid } from '@farpoint/safety';
import {
  DEFAULT_LIMITS,
  officeWorld,
  SimulatedBase,
  SimulatedCamera,
  THING_SIZE,
  withThings,
} from '@farpoint/sim';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { expect, it } from 'vitest';
import { CloudGuard } from '../../sense/obstacles/cloud-guard.ts';
import { makeSharedGrid, SharedGridReader } from '../../sense/obstacles/shared-grid.ts';
import { GRID_SHAPE, mountOf } from './guarded-sensors.ts';

const SIZE = 240;
const STEP_S = 0.05;
const AHEAD_M = 1.2;

it('a low thing 0.3 m before the robot, which the camera sees no longer, is told to a few centimetres', async () => {
  const codec = await loadCodecFromDisk();
  const world = withThings(officeWorld(), [{ ahead: AHEAD_M, left: 0, height: 0.09 }]);
  const base = new SimulatedBase(world);
  const camera = await SimulatedCamera.create({ world, seed: 1, camera: { width: SIZE, height: SIZE } });
  const { fx, fy, cx, cy } = camera.intrinsics;
  const mount = mountOf({ kind: 'sim', seed: 1, size: SIZE })!;
  const memory = makeSharedGrid(GRID_SHAPE);
  using clouds = new CloudGuard(
    codec,
    {
      ...{ kind: 'sim', width: SIZE, height: SIZE, capacity: SIZE * SIZE },
      ...{ camera: { fx, fy, cx, cy }, depthMeasure: 'z' },
    },
    {
      ...{ memory, shape: GRID_SHAPE, mount, odometry: true, blankIsMissing: true },
      ...{ clearanceM: 0.04, heightM: 1.1, dropM: 0.15 },
    },
  );
  const reader = new SharedGridReader(memory, GRID_SHAPE);
  const guard = new ObstacleGuard(Footprint.disc(DEFAULT_LIMITS.radius), 1);
  const side = world.start.x + AHEAD_M - THING_SIZE / 2;
  const trueM = () => side - base.state.pose.position.x - DEFAULT_LIMITS.radius;
  const errors: number[] = [];
  let newest: SensorGrid | null = null;
  let nowMs = 1000;
  const ahead = () => guard.nearField(nowMs)?.[0]?.hit ?? null;
  for (; trueM() > 0.3; nowMs += 1000 * STEP_S) {
    const { pose, yaw, twist } = base.state;
    guard.moved({ x: pose.position.x, y: pose.position.y, yaw }, twist, nowMs);
    const { depth, cameraPose } = camera.render(base.snapshot, { points: false });
    clouds.take({ form: 'images', depth, colour: new Uint32Array(), cameraPose, capturedAtMs: nowMs });
    newest = reader.read();
    guard.see(0, newest!);
    const hit = ahead();
    expect(hit?.kind).toBe('thing');
    errors.push((hit?.metres ?? Number.NaN) - trueM());
    base.setCommand({ linear: { x: 0.2, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0 } });
    base.step(STEP_S);
  }
  camera.close();
  expect(Math.max(...errors.map(Math.abs))).toBeLessThan(0.08);
  // The camera itself no longer shows its nearest side.
  const at = (x: number) => {
    const [i, j] = [Math.floor(x / 0.05) - newest!.firstX, Math.floor(world.start.y / 0.05) - newest!.firstY];
    return newest!.classes[j * newest!.side + i];
  };
  expect(at(side + 0.025)).not.toBe(floorClasses.occupied);
  const { pose, yaw, twist } = base.state;
  guard.moved({ x: pose.position.x, y: pose.position.y, yaw }, twist, nowMs);
  expect(ahead()?.metres).toBeGreaterThan(0.22);
  expect(ahead()?.metres).toBeLessThan(0.38);
  // Behind it, nobody has looked.
  expect(guard.nearField(nowMs)?.[36]?.unseen?.fromM).toBeLessThan(0.1);
}, 30_000);
