/** Where a frame was captured, and what lies in its view: changes between the world and the sensor's frame. */
import { rotationMatrix } from '@farpoint/protocol';
import type { FrameSamples } from './frame-samples.ts';
import type { KeyFrame } from './key-frame.ts';
import { CHUNK_M } from './memory-layout.ts';
import { RangePicture } from './range-picture.ts';

/** Half of a chunk's diagonal, metres. */
const CHUNK_RADIUS = (CHUNK_M * Math.sqrt(3)) / 2;

export class SensorView {
  /** Position of the sensor in the world, metres. */
  readonly position = new Float64Array(3);
  /** Rows of the rotation from the sensor's frame to the world's. */
  readonly rotation = new Float64Array(9);
  readonly picture = new RangePicture();
  /** The farthest that was seen, metres. */
  farthest = 0;
  /** The widest angle from the sensor's z axis at which something was seen, radians. */
  widest = 0;

  /** Takes a frame's pose, and what was seen. */
  set(frame: KeyFrame, samples: FrameSamples): void {
    for (let i = 0; i < 3; i++) this.position[i] = frame.pose(i);
    const [x, y, z, w] = [frame.pose(3), frame.pose(4), frame.pose(5), frame.pose(6)];
    this.rotation.set(rotationMatrix({ x, y, z, w }));
    this.picture.clear();
    let farthest = 0;
    let least = 1;
    for (let i = 0; i < samples.count; i++) {
      const [sampleZ, range] = [samples.z[i] as number, samples.ranges[i] as number];
      this.picture.add(samples.x[i] as number, samples.y[i] as number, sampleZ, range);
      if (range > farthest) farthest = range;
      if (sampleZ / range < least) least = sampleZ / range;
    }
    this.farthest = farthest;
    this.widest = Math.acos(Math.max(least, -1));
  }

  /** Distance of a place from the sensor, metres. */
  distanceTo(x: number, y: number, z: number): number {
    const { position } = this;
    return Math.hypot(x - (position[0] as number), y - (position[1] as number), z - (position[2] as number));
  }

  /** Whether some of a chunk may be in view. @param x coordinates of its centre in the world */
  mayShow(x: number, y: number, z: number): boolean {
    const distance = this.distanceTo(x, y, z);
    if (distance <= CHUNK_RADIUS) return true;
    if (distance > this.farthest + CHUNK_RADIUS) return false;
    const { position, rotation } = this;
    const along =
      (rotation[2] as number) * (x - (position[0] as number)) +
      (rotation[5] as number) * (y - (position[1] as number)) +
      (rotation[8] as number) * (z - (position[2] as number));
    const angle = Math.acos(Math.min(Math.max(along / distance, -1), 1));
    return angle < this.widest + Math.asin(CHUNK_RADIUS / distance);
  }
}
