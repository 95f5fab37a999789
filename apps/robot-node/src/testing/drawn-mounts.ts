/** Sensors of which each run has others, somewhere else on the robot. */
import { DEFAULT_CAMERA, DEFAULT_LIMITS } from '@farpoint/sim';

/** Where a camera sits on the robot, as the simulator names it: metres and radians. */
export interface DrawnMount {
  forward: number;
  left: number;
  up: number;
  /** Positive downwards. */
  pitch: number;
  yaw: number;
}

const MOST_SENSORS = 3;
/** From the robot's axis, and from the height of its usual camera, metres. */
const MOST_OFFSET_M = 0.5;
const MOST_PITCH = 0.7;
/** The robot's outline goes so far beyond its outermost sensor, metres. */
const RIM_M = 0.03;

/** One to three sensors, each anywhere within ±0.5 m, pitched by up to ±0.7 rad and turned any way. */
export function drawMounts(random: () => number): DrawnMount[] {
  const within = (most: number) => (random() * 2 - 1) * most;
  return Array.from({ length: 1 + Math.floor(random() * MOST_SENSORS) }, () => ({
    ...{ forward: within(MOST_OFFSET_M), left: within(MOST_OFFSET_M) },
    up: DEFAULT_CAMERA.up + within(MOST_OFFSET_M),
    ...{ pitch: within(MOST_PITCH), yaw: within(Math.PI) },
  }));
}

/** The radius of a round robot that carries them, metres. */
export function radiusAround(mounts: readonly DrawnMount[]): number {
  const outermost = Math.max(...mounts.map(({ forward, left }) => Math.hypot(forward, left)));
  return Math.max(DEFAULT_LIMITS.radius, outermost + RIM_M);
}

/** Ahead (1) or back (−1): where the sensors look, together, and so where an operator drives who sees by them. */
export function towardsView(mounts: readonly DrawnMount[]): 1 | -1 {
  return mounts.reduce((sum, { yaw }) => sum + Math.cos(yaw), 0) >= 0 ? 1 : -1;
}
