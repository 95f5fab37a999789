/** From a topic's bytes to the grid that the main thread reads. */
import { zeroTwist } from '@farpoint/protocol';
import { decoderOf } from '@farpoint/ros';
import { messageBytes } from '@farpoint/ros/testing';
import { floorClasses, PoseTrack, type SensorGrid } from '@farpoint/safety';
import { describe, expect, it } from 'vitest';
import { bodyMount } from '../sources/sensor-mount.ts';
import { type Placing, ScanGuard } from './scan-guard.ts';
import { makeSharedGrid, SharedGridReader } from './shared-grid.ts';

const TYPE = 'sensor_msgs/msg/LaserScan';
const SHAPE = { side: 160, cellM: 0.05 };
const DAY_MS = 1.7e12;
const RAYS = 360;
const { free, occupied, unknown } = floorClasses;

const MOUNT = { x: 0.2, y: 0, z: 0.3, roll: 0, pitch: 0, yaw: 0 };

function start(version: 1 | 2, odometry = true, placing?: Placing) {
  let nowMs = 0;
  const poses = new PoseTrack();
  const memory = makeSharedGrid(SHAPE);
  const guard = new ScanGuard(
    { memory, shape: SHAPE, mount: MOUNT, odometry, clearanceM: 0.04, heightM: 1.1 },
    poses,
    { now: () => nowMs, wallNs: () => BigInt(Math.round((DAY_MS + nowMs) * 1e6)) },
    placing,
  );
  const reader = new SharedGridReader(memory, SHAPE);
  const decode = decoderOf(version, TYPE, null);
  return {
    poses,
    reader,
    /** A scan that was captured then and arrives 20 ms later; what is ahead. */
    scan(atMs: number, ahead: number, more: object = {}): SensorGrid | null {
      nowMs = atMs + 20;
      const ns = BigInt(Math.round((DAY_MS + atMs) * 1e6));
      const [sec, nanosec] = [Number(ns / 1_000_000_000n), Number(ns % 1_000_000_000n)];
      const ranges = Array.from({ length: RAYS }, (_, i) => (Math.abs(i - 180) < 20 ? ahead : Number.NaN));
      const message = {
        header: { stamp: version === 1 ? { sec, nsec: nanosec } : { sec, nanosec }, frame_id: 'laser' },
        ...{ angle_min: -Math.PI, angle_max: Math.PI, angle_increment: (2 * Math.PI) / RAYS },
        ...{ time_increment: 0, scan_time: 0.1, range_min: 0.1, range_max: 12, ranges, intensities: [] },
        ...more,
      };
      guard.take(decode(messageBytes(version, TYPE, message)), nowMs);
      return reader.read();
    },
  };
}

function classAt(grid: SensorGrid | null, x: number, y: number): number | undefined {
  if (grid === null) return undefined;
  const [i, j] = [Math.floor(x / 0.05) - grid.firstX, Math.floor(y / 0.05) - grid.firstY];
  return grid.classes[j * SHAPE.side + i];
}

describe.each([1, 2] as const)('ROS %i', (version) => {
  it('scans show what is around the robot, where it was when they were taken', () => {
    const { poses, scan, reader } = start(version);
    // Odometry comes later than the scan.
    poses.measured({ x: 5.02, y: -3, yaw: Math.PI / 2 }, zeroTwist(), 990);
    poses.measured({ x: 5.42, y: -3, yaw: Math.PI / 2 }, zeroTwist(), 1010);
    const grid = scan(1000, 1.52);
    expect([grid?.placed, reader.count.grids]).toEqual([true, 1]);
    expect(grid?.capturedAtMs).toBeCloseTo(1000, 1);
    // Ahead is along y: 0.2 m to the scanner and 1.52 m on.
    expect(classAt(grid, 5.22, -3 + 1.72)).toBe(occupied);
    expect(classAt(grid, 5.22, -3 + 1.2)).toBe(free);
    expect(classAt(grid, 5.22, -3 - 1)).toBe(unknown);
  });

  it('without odometry, scans lie around base_link', () => {
    const grid = start(version, false).scan(1000, 1.52);
    expect([grid?.placed, grid?.firstX]).toEqual([false, -80]);
    expect(classAt(grid, 1.72, 0.02)).toBe(occupied);
  });
});

it('says nothing with no measurement at all, without a pose, or again', () => {
  const { poses, scan } = start(2);
  expect(scan(900, 1)).toBeNull();
  poses.measured({ x: 0, y: 0, yaw: 0 }, zeroTwist(), 1000);
  expect(scan(1000, Number.NaN)).toBeNull();
  expect(scan(1010, 0)).toBeNull();
  expect(scan(1020, Number.POSITIVE_INFINITY)).not.toBeNull();
  expect(scan(1020, 1)).toBeNull();
  expect(scan(1010, 1)).toBeNull();
});

it('straightens a sweep that takes time', () => {
  const { poses, scan } = start(2);
  const twist = zeroTwist();
  twist.angular.z = 1;
  for (let ms = 900; ms <= 1300; ms += 20) poses.measured({ x: 0, y: 0, yaw: (ms - 1000) / 1000 }, twist, ms);
  // A tenth of a second a sweep: ahead is measured half of that later, by when the robot has turned by 0.05 rad.
  const grid = scan(1000, 3, { time_increment: 0.1 / RAYS });
  const angle = (19 * 2 * Math.PI) / RAYS;
  for (const [at, known] of [
    [angle + 0.05, occupied],
    [-angle + 0.05, occupied],
  ] as const) {
    const yaw = 0.05;
    expect(
      classAt(grid, 0.2 * Math.cos(yaw) + 3 * Math.cos(at), 0.2 * Math.sin(yaw) + 3 * Math.sin(at)),
    ).toBe(known);
  }
});

it.each([
  ['no rays', { ranges: [] }],
  ['an increment that is none', { angle_increment: 0 }],
  ['more than a turn', { angle_increment: 0.1 }],
  ['angles that are none', { angle_min: Number.NaN }],
  ['ranges that are none', { range_max: Number.NaN }],
])('refuses %s', (_, more) => {
  const { poses, scan, reader } = start(2);
  poses.measured({ x: 0, y: 0, yaw: 0 }, zeroTwist(), 1000);
  expect(() => scan(1000, 1, more)).toThrow();
  expect(reader.read()).toBeNull();
});

it.each([
  ['2 cm to the side', { ...MOUNT, y: 0.019 }, false],
  ['farther to the side', { ...MOUNT, y: 0.021 }, true],
  ['lower', { ...MOUNT, z: 0.25 }, true],
  ['turned by a degree', { ...MOUNT, yaw: 0.017 }, false],
  ['turned by more', { ...MOUNT, yaw: 0.018 }, true],
  ['upside down', { ...MOUNT, roll: Math.PI }, true],
])('a scanner that tf places %s', (_, told, isDisputed) => {
  const asked: [string, number][] = [];
  const { poses, scan, reader } = start(2, true, (frameId, atMs) => {
    asked.push([frameId, Math.round(atMs)]);
    return bodyMount(told);
  });
  poses.measured({ x: 0, y: 0, yaw: 0 }, zeroTwist(), 1000);
  if (isDisputed) {
    expect(() => scan(1000, 1)).toThrow('guard.scans and tf disagree about where laser sits, by');
    expect(reader.read()).toMatchObject({ disputed: true, placed: true });
  } else expect(scan(1000, 1)).toMatchObject({ disputed: false });
  expect(asked).toEqual([['laser', 1000]]);
});
