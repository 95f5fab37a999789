/**
 * Maps the stick's deflection to −1…1. Inside the dead zone the result is 0. Outside it, the result rises from 0
 * without a step. A larger `expo` makes it gentler around the centre.
 */
export interface StickResponse {
  /** Share of the deflection that counts as centred, 0 ≤ d < 1. */
  deadZone: number;
  /** 0: linear; 1: cubic. */
  expo: number;
}

/**
 * Chosen: sticks that are worn rest farther from the middle than new ones, and XInput's own dead zone, 0.24, would
 * take the slow speeds away; the curve makes the middle gentle. drive.test.ts has its shape.
 */
export const DEFAULT_STICK_RESPONSE: Readonly<StickResponse> = { deadZone: 0.12, expo: 0.4 };

/** @param deflection −1…1. Anything that is not a finite number counts as 0, because a device may report null axes. */
export function shapeAxis(deflection: number | null | undefined, response: StickResponse): number {
  if (typeof deflection !== 'number' || !Number.isFinite(deflection)) return 0;
  const magnitude = Math.min(Math.abs(deflection), 1);
  if (magnitude <= response.deadZone) return 0;
  const t = (magnitude - response.deadZone) / (1 - response.deadZone);
  const shaped = (1 - response.expo) * t + response.expo * t * t * t;
  return deflection < 0 ? -shaped : shaped;
}
