/** A room of 6 × 4 × 2.5 m with a depth camera in it, and a box that may stand there; for tests. */
import { multiply, type Pose, rotate } from '@farpoint/protocol';
import { depthKeyFrame } from '../../testing/depth-key-frame.ts';
import type { KeyFrame } from '../key-frame.ts';

interface Place {
  x: number;
  y: number;
  z: number;
}

export interface RoomBox {
  from: Place;
  to: Place;
}

export const ROOM: RoomBox = { from: { x: 0, y: -2, z: 0 }, to: { x: 6, y: 2, z: 2.5 } };
const WIDTH = 160;
const HEIGHT = 120;
const INTRINSICS = { width: WIDTH, height: HEIGHT, fx: 80, fy: 80, cx: 79.5, cy: 59.5 };
/** From the optical frame (z forward, x right, y down) to a body's (x forward, y left, z up). */
const OPTICAL = { x: -0.5, y: 0.5, z: -0.5, w: 0.5 };
const RED = 0xff;

/** A camera 1 m above the floor. @param yaw about z, radians */
export function cameraAt(x: number, y: number, yaw: number): Pose {
  const turn = { x: 0, y: 0, z: Math.sin(yaw / 2), w: Math.cos(yaw / 2) };
  return { position: { x, y, z: 1 }, orientation: multiply(turn, OPTICAL) };
}

/**
 * What the camera sees at this time.
 *
 * @param noise of depth at 1 m, metres; called for each pixel
 */
export function frameOfRoom(
  cameraPose: Pose,
  nowMs: number,
  boxes: readonly RoomBox[] = [],
  noise: () => number = () => 0,
): KeyFrame {
  const depth = new Float32Array(WIDTH * HEIGHT);
  const colour = new Uint8Array(WIDTH * HEIGHT * 4).fill(128);
  for (let v = 0; v < HEIGHT; v++) {
    for (let u = 0; u < WIDTH; u++) {
      const ray = { x: (u - INTRINSICS.cx) / INTRINSICS.fx, y: (v - INTRINSICS.cy) / INTRINSICS.fy, z: 1 };
      const along = rotate(cameraPose.orientation, ray);
      const { position } = cameraPose;
      let z = farSide(position, along, ROOM);
      for (const box of boxes) {
        const before = z;
        z = Math.min(z, nearSide(position, along, box));
        if (z < before) colour.set([RED, 0, 0, 255], (v * WIDTH + u) * 4);
      }
      depth[v * WIDTH + u] = z + noise() * z * z;
    }
  }
  return depthKeyFrame({ intrinsics: INTRINSICS, cameraPose, depth, colour }, 1, nowMs);
}

const AXES = ['x', 'y', 'z'] as const;

/** How far along a ray from inside a box its side is. */
function farSide(from: Place, along: Place, box: RoomBox): number {
  return Math.min(
    ...AXES.map((axis) => ((along[axis] > 0 ? box.to : box.from)[axis] - from[axis]) / along[axis]),
  );
}

/** How far along a ray from outside a box its side is; infinite if it does not meet it. */
function nearSide(from: Place, along: Place, box: RoomBox): number {
  const enters = Math.max(
    ...AXES.map((axis) => ((along[axis] > 0 ? box.from : box.to)[axis] - from[axis]) / along[axis]),
  );
  return enters > 0 && enters < farSide(from, along, box) ? enters : Number.POSITIVE_INFINITY;
}
