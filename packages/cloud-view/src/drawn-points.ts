import type { Pose } from '@farpoint/operator';

/** The pose of one of the two frames that are drawn. */
export interface FramePose extends Pose {
  /** One step of a coordinate, metres. */
  unit: number;
}

/** The points that are drawn, copied from the GPU. */
export interface DrawnPoints {
  /** Four numbers a point: x, y, z in units of the frame's pose, and the colour's bits. */
  points: Int16Array;
  /** For each point the slot of its frame's pose; `null` where it is hidden. */
  slots: (number | null)[];
}
