/** From a simulated sensor's whole cloud to the grid that the main thread reads. */

import type { SourceDescription, SourceFrame } from '@farpoint/cloud-source';
import { floorClasses, type SensorGrid } from '@farpoint/safety';
import { DEFAULT_CAMERA, officeWorld, SimulatedBase, SimulatedCamera, SimulatedLidar } from '@farpoint/sim';
import { cellClasses } from '@farpoint/wasm-codec';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { describe, expect, it } from 'vitest';
import { mountOf } from '../../motion/obstacles/guarded-sensors.ts';
import { STATIC_CAMERA_POSE } from '../sources/playback-source.ts';
import { opticalMount } from '../sources/sensor-mount.ts';
import { CloudGuard, type CloudGuardOptions } from './cloud-guard.ts';
import { makeSharedGrid, SharedGridReader } from './shared-grid.ts';

const SHAPE = { side: 160, cellM: 0.05 };
const AT_HOME = { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
const world = officeWorld();

function optionsFor(kind: 'sim' | 'sim-lidar'): CloudGuardOptions {
  const source = kind === 'sim' ? { kind, seed: 1, size: 240 } : { kind, seed: 1 };
  const mount = mountOf(source)!;
  const memory = makeSharedGrid(SHAPE);
  return { memory, shape: SHAPE, mount, odometry: true, clearanceM: 0.04, heightM: 1.1, dropM: 0.15 };
}

function classAt(grid: SensorGrid, x: number, y: number): number | undefined {
  const [i, j] = [Math.floor(x / 0.05) - grid.firstX, Math.floor(y / 0.05) - grid.firstY];
  return grid.classes[j * 160 + i];
}

describe('the simulated camera’s clouds', async () => {
  const codec = await loadCodecFromDisk();
  const camera = await SimulatedCamera.create({ world, seed: 1, camera: { width: 240, height: 240 } });
  const { fx, fy, cx, cy } = camera.intrinsics;
  const lens = { fx, fy, cx, cy };
  const description: SourceDescription = {
    ...{ kind: 'sim', width: 240, height: 240, capacity: 57_600, camera: lens, depthMeasure: 'z' },
  };
  const options = optionsFor('sim');
  const frameAt = (x: number, y: number, yaw: number, capturedAtMs: number): SourceFrame => {
    const base = new SimulatedBase(world);
    base.teleport(x, y, yaw);
    const { depth, cameraPose } = camera.render(base.snapshot, { points: false });
    return { form: 'images', depth, colour: new Uint32Array(), cameraPose, capturedAtMs };
  };

  it('come from where the camera sits', () => {
    const seen = camera.poseAt(AT_HOME);
    expect(options.mount.position).toEqual(seen.position);
    for (const axis of ['x', 'y', 'z', 'w'] as const) {
      expect(options.mount.orientation[axis]).toBeCloseTo(seen.orientation[axis]);
    }
  });

  it('show walls and floor where they are in the world, whichever way the robot looks', () => {
    using guard = new CloudGuard(codec, description, options);
    const reader = new SharedGridReader(options.memory, SHAPE);
    // In the corridor between the walls at y = 5 and y = 7.
    for (const [yaw, facing] of [
      [Math.PI / 2, 6.93],
      [-Math.PI / 2, 5.07],
    ] as const) {
      guard.take(frameAt(7.5, 6, yaw, 40));
      const grid = reader.read()!;
      expect([grid.capturedAtMs, grid.placed]).toEqual([40, true]);
      expect(classAt(grid, 7.5, facing)).toBe(floorClasses.occupied);
      expect(classAt(grid, 7.5, 6 + Math.sign(yaw) * 0.82)).toBe(floorClasses.free);
      expect(classAt(grid, 7.5, 6 - Math.sign(yaw) * 0.5)).toBe(floorClasses.unknown);
      expect(classAt(grid, 7.5, facing + Math.sign(yaw) * 0.4)).toBe(floorClasses.unknown);
    }
  });

  it('say nothing with a pose that is none', () => {
    using guard = new CloudGuard(codec, description, options);
    const frame = frameAt(7.5, 6, 0, 42);
    const orientation = { x: Number.NaN, y: 0, z: 0, w: 1 };
    guard.take({ ...frame, cameraPose: { ...frame.cameraPose, orientation } });
    expect(new SharedGridReader(options.memory, SHAPE).read()).toBeNull();
  });

  it('lie around base_link where nobody knows the pose', () => {
    using guard = new CloudGuard(codec, description, options);
    const reader = new SharedGridReader(options.memory, SHAPE);
    guard.take({ ...frameAt(7.5, 6, Math.PI / 2, 41), cameraPose: STATIC_CAMERA_POSE });
    const grid = reader.read()!;
    expect([grid.placed, grid.firstX, grid.firstY]).toEqual([false, -80, -80]);
    expect(classAt(grid, 0.93, 0)).toBe(floorClasses.occupied);
  });
});

it('finds what a LiDAR’s points hit, and no floor that it cannot see', async () => {
  const lidar = await SimulatedLidar.create({ world, seed: 1 }, { up: 1.1 });
  const description: SourceDescription = {
    ...{ kind: 'lidar', width: lidar.capacity, height: 1, capacity: lidar.capacity },
    ...{ camera: null, depthMeasure: 'range' },
  };
  const options = optionsFor('sim-lidar');
  using guard = new CloudGuard(await loadCodecFromDisk(), description, options);
  const base = new SimulatedBase(world);
  base.teleport(7.5, 6, 0.3);
  const { points, pose } = lidar.turn(base.snapshot);
  guard.take({ form: 'points', points, count: points.length / 4, cameraPose: pose, capturedAtMs: 1 });
  const grid = new SharedGridReader(options.memory, SHAPE).read()!;
  for (const y of [6.93, 5.07]) expect(classAt(grid, 7.5, y)).toBe(floorClasses.occupied);
  expect(classAt(grid, 7.5, 6.5)).toBe(floorClasses.unknown);
});

it('turns roll, pitch and yaw about fixed axes, pitch downwards', () => {
  const { z, w } = opticalMount({ x: 0, y: 0, z: 1, roll: 0, pitch: 0, yaw: 0 }).orientation;
  expect([z, w]).toEqual([-0.5, 0.5]);
  expect(DEFAULT_CAMERA.pitch).toBeGreaterThan(0);
});

it('numbers its classes as the guard does', () => {
  expect(floorClasses).toEqual(cellClasses);
});
