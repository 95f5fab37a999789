import { topicAs } from '@farpoint/ros';
import {
  defaultGeofenceOptions,
  EarthFrame,
  type Fence,
  FenceError,
  Footprint,
  parseFence,
} from '@farpoint/safety';
import type { FenceOptions } from '../../motion/geofence/open-geofence.ts';
import { SIM_FIX } from '../../sense/base/sim-topics.ts';
import { footprintOf } from './guard.ts';
import { readText } from './read-text.ts';
import type { RobotOptionKey, RobotOptionValues } from './robot-program.ts';
import { configuresOdometry } from './sink.ts';

/** The fence keeps this much more than the footprint inside: a base skids, and its odometry slips. Chosen. */
const BESIDE_FOOTPRINT_M = 0.25;
/** Beyond a fence nothing else stops the robot, so it counts on half of the deceleration that the base is said to reach. */
const BRAKE_SHARE = 0.5;

const EVERYWHERE: Fence = { allowed: [], forbidden: [], slow: [], radiusM: null };

/** The fence that is configured; undefined if none is. @param refuse takes what is wrong */
export function toFence(
  values: RobotOptionValues,
  refuse: (key: RobotOptionKey, detail: string) => void,
): FenceOptions | undefined {
  const { fence: path, fenceRadiusM: radiusM, fencePosition: position, simOrigin } = values;
  if (path === null && radiusM === null) return undefined;
  const byFix = position === 'fix';
  const given = values.fenceOrigin ?? (simOrigin === null ? null : { ...simOrigin, turnDeg: 0 });
  let fence = EVERYWHERE;
  let earth = given === null ? null : new EarthFrame(given);
  if (path !== null) {
    const text = readText(path, (detail) => refuse('fence', detail));
    if (text === null) return undefined;
    try {
      const parsed = parseFence(text, given ?? (byFix ? 'first' : null));
      fence = parsed.fence;
      earth = parsed.earth ?? earth;
    } catch (error) {
      if (!(error instanceof FenceError)) throw error;
      refuse('fence', `${path}: ${error.message}`);
      return undefined;
    }
  }
  const topic = topicAs(values.topics, 'fix')?.topic ?? (simOrigin === null ? undefined : SIM_FIX.topic);
  if (byFix && earth === null)
    refuse('fencePosition', 'needs --fence-origin, or a fence with positions on the earth, for fix');
  if (byFix && topic === undefined) refuse('fencePosition', 'needs a topic with `as: fix`, for fix');
  if (byFix && (earth === null || topic === undefined)) return undefined;
  if (!configuresOdometry(values.source, values.topics)) {
    refuse(
      'fencePosition',
      'needs odometry: the source sim, or ros1 or ros2 with a topic of nav_msgs/Odometry with `as: pose`',
    );
    return undefined;
  }
  return {
    fence: { ...fence, radiusM },
    fix: byFix && earth !== null && topic !== undefined ? { earth, topic } : null,
    errorM: values.fenceErrorM,
    limits: {
      ...defaultGeofenceOptions,
      radiusM: new Footprint(footprintOf(values.footprint)).reach + BESIDE_FOOTPRINT_M,
      brakeMps2: Math.min(values.decelerationMps2 * BRAKE_SHARE, values.emergencyMps2),
      maxAgeMs: values.fenceMaxAgeMs,
    },
  };
}
