/** One truth about where a camera sits, for a producer in shared memory that gives its camera's poses. */
import { testFolder } from '@farpoint/service/testing/folder';
import { CloudProducer, isAvailable } from '@farpoint/shared-memory';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { describe, expect, it } from 'vitest';
import { CloudShmSource } from '../../sense/sources/cloud-shm-source.ts';
import { opticalMount, type SensorMount } from '../../sense/sources/sensor-mount.ts';
import { BEGAN_MS, driveAtWall, opticalPoints, opticalPose, WALL_POINTS } from '../../testing/wall-drive.ts';

const level: SensorMount = { x: 0, y: 0, z: 0.9, roll: 0, pitch: 0, yaw: 0 };
const HEADER = { width: WALL_POINTS, height: 1, lens: null, latencyTest: false };

describe.skipIf(!isAvailable())('shared memory (needs the addon: pnpm build:native)', async () => {
  const codec = await loadCodecFromDisk();

  async function drive(
    mount: SensorMount,
    options: { speed?: number; aheadMs?: number; poses?: boolean } = {},
  ) {
    const { speed = 0.6, aheadMs = 0, poses = true } = options;
    let nowMs = BEGAN_MS;
    const folder = testFolder();
    using producer = new CloudProducer({ folder, format: 'points', maxPoints: WALL_POINTS });
    const empty = new Float32Array(WALL_POINTS * 4).fill(Number.NaN);
    const bytes = (points: Float32Array) => ({ points: new Uint8Array(points.buffer) });
    producer.publish(bytes(empty), { ...HEADER, capturedAtMs: null, pose: null });
    const source = await CloudShmSource.open(
      { folder, waitMs: 1000, mount: opticalMount(mount) },
      () => nowMs,
    );
    const faults = new Set<string>();
    source.onFault = ({ message }) => faults.add(message);
    const driven = driveAtWall(codec, {
      ...{ mount, source, speed, odometry: false },
      setNow: (ms) => {
        nowMs = ms;
      },
      feed: (truth) => {
        const pose = poses ? opticalPose(truth.base, mount) : null;
        const header = { ...HEADER, capturedAtMs: truth.nowMs + aheadMs, pose };
        producer.publish(bytes(opticalPoints(truth.points, WALL_POINTS)), header);
      },
    });
    source.close();
    return { ...driven, faults: [...faults], state: source.state };
  }

  it.each([
    ['level', level],
    ['pitched by 0.35', { ...level, x: 0.1, pitch: 0.35 }],
    ['pitched by 0.7', { ...level, x: 0.2, z: 1.1, pitch: 0.7 }],
    ['offset', { ...level, x: -0.5, y: 0.45, z: 0.5 }],
    ['yawed and rolled', { ...level, x: 0.3, y: -0.2, yaw: 1.1, roll: 0.3 }],
    ['rear', { ...level, x: -0.4, pitch: 0.4, yaw: Math.PI }],
  ])('a camera that is %s stops the robot before the wall', async (_, mount) => {
    const { gapM, contactMps, fastestMps, faults, state } = await drive(mount, {
      speed: mount.yaw > 2 ? -0.6 : 0.6,
    });
    expect([contactMps, faults]).toEqual([null, []]);
    expect(gapM).toBeGreaterThan(0.03);
    expect(gapM).toBeLessThan(0.35);
    expect(fastestMps).toBeGreaterThan(0.5);
    // The robot is where its camera and the mount say.
    expect(Math.abs(state.pose.position.x)).toBeCloseTo(1.5 - gapM, 1);
    expect(Math.hypot(state.pose.position.y, state.pose.position.z)).toBeLessThan(0.001);
    expect(state.twist).toBeNull();
  });

  it('frames from the future stop nobody from seeing the wall, and say so', async () => {
    const { gapM, contactMps, fastestMps, faults } = await drive(level, { aheadMs: 86_400_000 });
    expect(faults).toEqual(['the producer says that a frame was captured in the future']);
    expect([contactMps, fastestMps > 0.31]).toEqual([null, false]);
    expect(gapM).toBeGreaterThan(0);
  });

  it('without poses, the guard works around the robot', async () => {
    const { gapM, contactMps, state } = await drive(level, { poses: false });
    expect([contactMps, state.measuredMs]).toEqual([null, null]);
    expect(gapM).toBeGreaterThan(0.03);
  });
});
