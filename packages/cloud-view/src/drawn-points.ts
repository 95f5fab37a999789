import type { Pose } from '@farpoint/operator';

/** The pose of one of the two drawn frames. */
export interface FramePose extends Pose {
  /** One step of a coordinate, metres. */
  unit: number;
}

/** The points that are drawn, copied from the GPU. */
export interface DrawnPoints {
  /** Four numbers per point: x, y, z in units of the frame's pose, and the colour's bits. */
  points: Int16Array;
  /** For each point the slot of its frame's pose; `null` if the point is hidden. */
  slots: (number | null)[];
}
