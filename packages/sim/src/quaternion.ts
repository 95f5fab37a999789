import type { Quaternion } from '@farpoint/protocol';
import { cos, sin } from './trigonometry.ts';

/** A rotation by `yaw` about z. */
export function fromYaw(yaw: number): Quaternion {
  return { x: 0, y: 0, z: sin(yaw / 2), w: cos(yaw / 2) };
}

/** From a body frame (x forward, y left, z up) to its optical frame (z forward, x right, y down), REP-103. */
export const BODY_TO_OPTICAL: Quaternion = { x: -0.5, y: 0.5, z: -0.5, w: 0.5 };
