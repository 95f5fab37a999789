/** The values that colours stand for, of single points on the CPU: the shader's formulas, for samples. */
import type { Quaternion } from '@farpoint/operator';

/** Weights of red, green and blue in brightness. ITU-R BT.601. */
export const LUMA_WEIGHTS = [0.299, 0.587, 0.114] as const;

/**
 * Robots send a LiDAR's intensity as a colour, from dark blue to yellow. These are the brightnesses, 0–255, of that
 * map's five stops at equal distances. Brightness only rises along the map, so that it gives the intensity back.
 */
export const INTENSITY_LUMAS = [30.495, 81.621, 110.942, 157.265, 215.462] as const;

/** Brightness of a point's 6-6-4 colour, 0–255, from the centres of its bins. */
export function lumaOf(colour: number): number {
  const [red, green, blue] = LUMA_WEIGHTS;
  return (
    red * (((colour >> 10) & 63) * 4 + 2) +
    green * (((colour >> 4) & 63) * 4 + 2) +
    blue * ((colour & 15) * 16 + 8)
  );
}

/** Intensity, 0–1, of a point's 6-6-4 colour. */
export function intensityOf(colour: number): number {
  const luma = lumaOf(colour);
  let sum = 0;
  for (let i = 1; i < INTENSITY_LUMAS.length; i++) {
    const [from, to] = [INTENSITY_LUMAS[i - 1] as number, INTENSITY_LUMAS[i] as number];
    sum += Math.min(Math.max((luma - from) / (to - from), 0), 1);
  }
  return sum / (INTENSITY_LUMAS.length - 1);
}

/** The z component of a vector turned by a unit quaternion. */
export function turnedZ({ x: qx, y: qy, z: qz, w: qw }: Quaternion, x: number, y: number, z: number): number {
  return 2 * (qx * qz - qw * qy) * x + 2 * (qy * qz + qw * qx) * y + (1 - 2 * (qx * qx + qy * qy)) * z;
}

/** Elevation of a point in the sensor's optical frame (y down), radians above the sensor's horizontal plane. */
export function elevationOf(x: number, y: number, z: number): number {
  return Math.atan2(-y, Math.hypot(x, z));
}
