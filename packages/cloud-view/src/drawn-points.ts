import type { Pose } from '@farpoint/operator';
import type { FrameWindow } from './frame-window.ts';
import type { PointRing } from './point-ring.ts';

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

/** Copies what is drawn out of the GPU. */
export function readDrawnPoints(window: FrameWindow, ring: PointRing): DrawnPoints {
  const drawn = window.tail - window.head;
  const points = new Int16Array(drawn * 4);
  if (drawn > 0) ring.read(window.head, points);
  const slots = Array.from({ length: drawn }, (_, i) => window.slotOf(window.head + i));
  return { points, slots };
}
