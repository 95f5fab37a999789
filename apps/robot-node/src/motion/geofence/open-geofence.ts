import type { TimedBaseState } from '@farpoint/cloud-source';
import { bodyYaw } from '@farpoint/protocol';
import {
  type EarthFrame,
  type Fence,
  type FencePose,
  FrozenPosition,
  Geofence,
  type GeofenceOptions,
} from '@farpoint/safety';
import { FixPosition } from './fix-position.ts';

/** A fence, and what says where the robot is. */
export interface FenceOptions {
  fence: Fence;
  /** The receiver that says where the robot is, and the fence's frame on the earth; `null`: odometry does. */
  fix: { topic: string; earth: EarthFrame } | null;
  /** How far off the position may be, m. */
  errorM: number;
  limits: GeofenceOptions;
}

export interface OpenedGeofence {
  geofence: Geofence;
  /** Takes the robot's readings, of which it needs the satellite receiver's; `null` if it needs none. */
  fix: FixPosition | null;
}

/**
 * @param state gives the newest of the base, as far as it is believed; `null` if nobody can tell where the robot is
 * @param isSimulated whether the base is simulated: then its state was measured at its time. Others say when, or their
 *   position is unknown
 * @param movesSideways whether the base can: one that cannot has no velocity to the side, whatever its odometry says
 */
export function openGeofence(
  { fence, fix: receiver, errorM, limits }: FenceOptions,
  state: () => TimedBaseState | null,
  isSimulated: boolean,
  movesSideways = false,
): OpenedGeofence {
  const fix = receiver === null ? null : new FixPosition(receiver.earth, receiver.topic);
  const frozen = new FrozenPosition(errorM);
  const pose = (): FencePose | null => {
    const known = state();
    if (known === null) return null;
    const odometry = poseOf(known, errorM, isSimulated, movesSideways);
    if (fix === null || odometry === null) return odometry;
    const { place } = fix;
    if (place === null || frozen.judge(place, odometry, odometry.atMs)) return null;
    return { ...odometry, x: place.x, y: place.y, yaw: null, atMs: Math.min(odometry.atMs, place.atMs) };
  };
  return { geofence: new Geofence(fence, limits, pose), fix };
}

/** `null` if nobody knows when the position was measured. */
function poseOf(
  { pose, twist, timeMs, measuredMs }: TimedBaseState,
  errorM: number,
  isSimulated: boolean,
  movesSideways: boolean,
): FencePose | null {
  const atMs = measuredMs === undefined && isSimulated ? timeMs : (measuredMs ?? null);
  if (atMs === null) return null;
  return {
    x: pose.position.x,
    y: pose.position.y,
    yaw: bodyYaw(pose.orientation),
    linear: twist?.linear.x ?? 0,
    ...(movesSideways ? { lateral: twist?.linear.y ?? 0 } : {}),
    angular: twist?.angular.z ?? 0,
    errorM,
    atMs,
  };
}
