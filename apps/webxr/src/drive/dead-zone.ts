/**
 * Stick deflection to a wish of −1…1: nothing within the dead zone, then rising from 0 without a step, softer around the
 * middle the larger `expo` is.
 */
export interface StickResponse {
  /** Share of the deflection that counts as rest, 0 ≤ d < 1. */
  deadZone: number;
  /** 0: linear; 1: cubic. */
  expo: number;
}

export const DEFAULT_STICK_RESPONSE: Readonly<StickResponse> = { deadZone: 0.12, expo: 0.4 };

/** @param deflection −1…1; anything that is not a finite number counts as 0 (a device may report null axes) */
export function shapeAxis(deflection: number | null | undefined, response: StickResponse): number {
  if (typeof deflection !== 'number' || !Number.isFinite(deflection)) return 0;
  const magnitude = Math.min(Math.abs(deflection), 1);
  if (magnitude <= response.deadZone) return 0;
  const t = (magnitude - response.deadZone) / (1 - response.deadZone);
  const shaped = (1 - response.expo) * t + response.expo * t * t * t;
  return deflection < 0 ? -shaped : shaped;
}
