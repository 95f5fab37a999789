/** A table's edge, which a low camera loses from view before the robot is there: the floor below it is still seen. */

import { shareInEachRun, someOf } from '@farpoint/network-sim/cases';
import { compose, rotationMatrix } from '@farpoint/protocol';
import { DEFAULT_LIMITS, SimulatedBase } from '@farpoint/sim';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';
import { describe, expect, it } from 'vitest';
import { opticalMount, type SensorMount } from '../../sense/sources/sensor-mount.ts';
import { guardedDrive, type StageCamera, seeded } from '../../testing/guarded-drive.ts';
import { EMPTY } from '../../testing/recorded-room.ts';

const SIZE = 160;
/** Of a camera that sees 29° up and down. */
const FOCAL = 144;
const BOARD_X = 3;
const { radius } = DEFAULT_LIMITS;

/** Sees a floor, and a board across the way from one height up to another. */
function cameraOf(
  base: SimulatedBase,
  sits: SensorMount,
  [from, to]: readonly [number, number],
): StageCamera {
  const mount = opticalMount(sits);
  const centre = (SIZE - 1) / 2;
  const depth = new Float32Array(SIZE * SIZE);
  return {
    description: {
      ...{ kind: 'sim', width: SIZE, height: SIZE, capacity: SIZE * SIZE, depthMeasure: 'z' },
      camera: { fx: FOCAL, fy: FOCAL, cx: centre, cy: centre },
    },
    ...{ mount, blankIsMissing: true },
    render() {
      const cameraPose = compose(base.state.pose, mount);
      const [r0, r1, r2, , , , r6, r7, r8] = rotationMatrix(cameraPose.orientation);
      const { x, z } = cameraPose.position;
      for (let i = 0; i < depth.length; i++) {
        const [a, b] = [((i % SIZE) - centre) / FOCAL, (Math.floor(i / SIZE) - centre) / FOCAL];
        const [toX, toZ] = [r0 * a + r1 * b + r2, r6 * a + r7 * b + r8];
        const board = toX > 0 ? (BOARD_X - x) / toX : 0;
        const height = z + toZ * board;
        const floor = toZ < 0 ? -z / toZ : 0;
        const seen =
          board > 0 && height >= from && height <= to && !(floor > 0 && floor < board) ? board : floor;
        depth[i] = seen > 0.2 && seen < 12 ? seen : 0;
      }
      return { depth, cameraPose };
    },
  };
}

const CAMERAS: [string, SensorMount][] = [
  ['a low camera', { x: 0.2, y: 0, z: 0.3, roll: 0, pitch: 0, yaw: 0 }],
  ['a low camera that looks down', { x: 0.2, y: 0, z: 0.35, roll: 0, pitch: 0.3, yaw: 0 }],
  ['a high camera', { x: 0.1, y: 0, z: 1, roll: 0, pitch: 0.35, yaw: 0 }],
];

// Each with one of the cameras in each run.
describe.each([
  ['a board from 0.55 m up', [0.55, 0.7], 0],
  ['a board from 0.75 m up', [0.75, 0.8], 1],
  ['a wall', [0, 2], 1],
  ['a box', [0, 0.15], 0],
] as const)('%s', async (_, span, from) => {
  const codec = await loadCodecFromDisk();

  it.each(someOf(CAMERAS, from, shareInEachRun(1 / 3)))('stops a robot with %s', (_, sits) => {
    const base = new SimulatedBase({ ...EMPTY, start: { x: 0, y: 0, yaw: 0 } });
    const clearanceAt = (x: number) => BOARD_X - x - radius;
    const run = guardedDrive(
      codec,
      {
        ...{ name: 'board', base, radius, cameras: [cameraOf(base, sits, span)], close: () => undefined },
        ...{ clearanceAt, edgeAt: () => Number.POSITIVE_INFINITY, isStill: () => true },
        touched: () => clearanceAt(base.state.pose.position.x) < 0,
      },
      // It gives up before it turns round.
      { seed: 1, random: seeded(1), speed: 0.6, seconds: 7 },
    );
    expect([run.contacts, run.unseenContacts]).toEqual([[], []]);
    expect(run.metres).toBeGreaterThan(1);
  });
});
