/** What a command costs the robot: judged, bounded by every guard that there is, and ramped. */
import { stampUsOf, zeroTwist } from '@farpoint/protocol';
import {
  BlindTravel,
  DriveGuard,
  defaultGeofenceOptions,
  FREE,
  Geofence,
  type MotionBound,
  type MotionGuard,
  MotionSupervisor,
  ViewAge,
} from '@farpoint/safety';
import { RAMPS, VIEW } from './stopping-run.ts';

/** The robot's clock never begins at 0. */
const START_MS = 1_000_000;
const SEEN_MS = 60;
const CORNERS = 100;
const FENCE_M = 50;

/** A fence far away that the robot must look at all the same. */
function fence(): Geofence {
  const ring = Array.from({ length: CORNERS }, (_, i) => {
    const turn = (2 * Math.PI * i) / CORNERS;
    return [FENCE_M * Math.cos(turn), FENCE_M * Math.sin(turn)] as const;
  });
  const allowed = [{ shape: 'polygon' as const, rings: [ring] }];
  const pose = { x: 0, y: 0, yaw: 0, linear: 0, angular: 0, errorM: 0, atMs: Number.POSITIVE_INFINITY };
  return new Geofence(
    { allowed, forbidden: [], slow: [], radiusM: null },
    defaultGeofenceOptions,
    () => pose,
  );
}

/**
 * Wraps the obstacle guard of a simulated drive in the whole way of a command.
 *
 * @param times takes how long each command took, ms
 */
export function supervised(times: number[]): (obstacles: MotionGuard) => MotionGuard {
  return (obstacles) => {
    let bound: Readonly<MotionBound> = FREE;
    const heard: MotionGuard = {
      bound(wish, nowMs) {
        bound = obstacles.bound(wish, nowMs - START_MS);
        return bound;
      },
    };
    const guard = new DriveGuard({
      limits: { maxLinear: 2, maxAngular: 3, watchdogMs: 150, maxCommandsPerSecond: 1000 },
      takePolicy: 'always',
      randomBytes: (count) => new Uint8Array(count).fill(7),
    });
    const { view } = guard;
    const motion = new MotionSupervisor(guard, {
      ramps: RAMPS,
      guards: [heard, fence()],
      driverGuards: [new ViewAge(view, VIEW), new BlindTravel(view, VIEW)],
    });
    guard.onOpenHand('driver');
    const granted = guard.requestLease('driver', false, START_MS);
    const lease = granted.granted ? granted.lease : '';
    let sequence = 0;
    return {
      bound(wish, driveMs) {
        const nowMs = START_MS + driveMs;
        const twist = {
          ...zeroTwist(),
          linear: { x: wish.linear.x, y: 0, z: 0 },
          angular: { x: 0, y: 0, z: wish.angular.z },
        };
        const command = {
          type: 'command' as const,
          sequence: sequence++,
          timeMs: nowMs,
          lease,
          deadMan: true,
          twist,
        };
        const seenUs = stampUsOf(nowMs - SEEN_MS);
        const begin = performance.now();
        view.sent(nowMs);
        guard.sentViews.sent('driver', nowMs - SEEN_MS);
        guard.onCommand('driver', { ...command, seenUs }, nowMs);
        motion.velocityAt(nowMs);
        times.push(performance.now() - begin);
        return bound;
      },
    };
  };
}
