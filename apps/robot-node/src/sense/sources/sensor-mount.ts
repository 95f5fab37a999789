/** Where a sensor sits on the robot. */
import { compose, inverse, multiply, OPTICAL_IN_BODY, type Pose, type Quaternion } from '@farpoint/protocol';

/** The pose of a sensor's body frame (x forward, y left, z up) in base_link: metres and radians, fixed axes. */
export interface SensorMount {
  x: number;
  y: number;
  z: number;
  roll: number;
  /** Positive downwards. */
  pitch: number;
  yaw: number;
}

/** The pose of its body frame in base_link. */
export function bodyMount({ x, y, z, roll, pitch, yaw }: SensorMount): Pose {
  const about = (axis: 'x' | 'y' | 'z', angle: number): Quaternion => ({
    x: 0,
    y: 0,
    z: 0,
    w: Math.cos(angle / 2),
    [axis]: Math.sin(angle / 2),
  });
  const orientation = multiply(multiply(about('z', yaw), about('y', pitch)), about('x', roll));
  return { position: { x, y, z }, orientation };
}

/** The pose of its optical frame in base_link. */
export function opticalMount(mount: SensorMount): Pose {
  const { position, orientation } = bodyMount(mount);
  return { position, orientation: multiply(orientation, OPTICAL_IN_BODY) };
}

/**
 * Two that say where a sensor sits may differ by so much: metres, radians. Chosen: a tape's and a spirit
 * level's error is below; 1° is 7 cm at 4 m, above the guard's clearance (docs/obstacle-guard.md).
 */
const MOST_OFF_M = 0.02;
const MOST_TURNED = Math.PI / 180;

/** By what two poses of one sensor differ, for people; `null` if they agree. */
export function mountDispute(one: Pose, other: Pose): string | null {
  const { position, orientation } = compose(inverse(one), other);
  const offM = Math.hypot(position.x, position.y, position.z);
  const turned = 2 * Math.acos(Math.min(1, Math.abs(orientation.w)));
  if (offM <= MOST_OFF_M && turned <= MOST_TURNED) return null;
  return `${Math.round(offM * 100)} cm and ${Math.round((turned * 180) / Math.PI)}°`;
}
