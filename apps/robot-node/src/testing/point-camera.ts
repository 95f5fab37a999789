/** Draws points as a depth camera somewhere would see them. */

import type { SourceDescription } from '@farpoint/cloud-source';
import { compose, inverse, type Pose, rotationMatrix } from '@farpoint/protocol';
import type { SimulatedBase } from '@farpoint/sim';
import type { StageCamera } from './guarded-drive.ts';

export interface PointCameraOptions {
  /** Pixels of each side. */
  size: number;
  /** Pixels. */
  focal: number;
  /** How large each point is drawn, metres. */
  cubeM: number;
}

/** The robot's camera sees nothing nearer, metres. */
const NEAR_M = 0.3;
const FAR_M = 15;

export class PointCamera implements StageCamera {
  readonly description: SourceDescription;
  readonly mount: Pose;
  /** What the recording did not see is not missing. */
  readonly blankIsMissing = false;
  readonly #points: Float32Array;
  readonly #options: PointCameraOptions;
  readonly #base: SimulatedBase;
  readonly #depth: Float32Array;

  /** @param points x, y, z in the world each, metres */
  constructor(points: Float32Array, mount: Pose, options: PointCameraOptions, base: SimulatedBase) {
    const { size, focal } = options;
    const centre = (size - 1) / 2;
    this.description = {
      ...{ kind: 'recorded', width: size, height: size, capacity: size * size, depthMeasure: 'z' },
      camera: { fx: focal, fy: focal, cx: centre, cy: centre },
    };
    this.mount = mount;
    this.#points = points;
    this.#options = options;
    this.#base = base;
    this.#depth = new Float32Array(size * size);
  }

  render(): { depth: Float32Array; cameraPose: Pose } {
    const { size, focal, cubeM } = this.#options;
    const depth = this.#depth.fill(0);
    const points = this.#points;
    const cameraPose = compose(this.#base.state.pose, this.mount);
    const { orientation, position } = inverse(cameraPose);
    const [r0, r1, r2, r3, r4, r5, r6, r7, r8] = rotationMatrix(orientation);
    const centre = (size - 1) / 2;
    for (let i = 0; i < points.length; i += 3) {
      const [x, y, z] = [points[i] as number, points[i + 1] as number, points[i + 2] as number];
      const far = r6 * x + r7 * y + r8 * z + position.z;
      if (far < NEAR_M || far > FAR_M) continue;
      const scale = focal / far;
      const u = (r0 * x + r1 * y + r2 * z + position.x) * scale + centre;
      const v = (r3 * x + r4 * y + r5 * z + position.y) * scale + centre;
      const half = (cubeM * scale) / 2;
      if (u + half < 0 || v + half < 0 || u - half > size || v - half > size) continue;
      const [left, right] = [Math.max(0, Math.round(u - half)), Math.min(size - 1, Math.round(u + half))];
      const [top, bottom] = [Math.max(0, Math.round(v - half)), Math.min(size - 1, Math.round(v + half))];
      for (let row = top; row <= bottom; row++) {
        for (let column = left; column <= right; column++) {
          const pixel = row * size + column;
          const before = depth[pixel] as number;
          if (before === 0 || far < before) depth[pixel] = far;
        }
      }
    }
    return { depth, cameraPose };
  }
}
