/**
 * How a base follows velocity commands: after a dead time each axis approaches gain · command with a first-order
 * lag, and no faster than its acceleration allows. Unicycle kinematics, and sideways where the base can. SI units, REP-103. Allocates nothing.
 */

/** One axis: along the heading in m/s, or about the vertical in rad/s. */
export interface AxisModel {
  /** The velocity that a command of 1 leads to. */
  gain: number;
  /** Time constant of the lag, s. */
  lagS: number;
  /** The most that the velocity changes away from zero, m/s² or rad/s². */
  rise: number;
  /** The most that it changes towards zero, m/s² or rad/s². */
  fall: number;
}

export interface BaseModel {
  /** From the sending of a command until the operator could see its first effect on the fastest way back, ms. */
  delayMs: number;
  linear: AxisModel;
  angular: AxisModel;
}

/** Where a base is and how fast it moves. */
export interface BaseMotion {
  /** base_link in the world, m. */
  x: number;
  y: number;
  /** Radians, not wrapped. */
  yaw: number;
  /** m/s along the heading. */
  linear: number;
  /** m/s to the left; 0 of a base that cannot go sideways. */
  lateral: number;
  /** rad/s, positive to the left. */
  angular: number;
}

/** Longest step of an integration, ms. */
export const STEP_MS = 10;

/** How fast a robot says that it changes its velocity. */
export interface BaseRamps {
  /** Away from zero and towards it, m/s². */
  accelerationMps2?: number | undefined;
  decelerationMps2?: number | undefined;
  /** Both ways, rad/s². */
  turnRadps2?: number | undefined;
}

/**
 * Lag of the motors of a robot that does not say how it ramps, and of one that does, s.
 * `pnpm bench prediction`, 150 ms: the first turn is off by up to 1.9° without ramps, and by 0.6° with them.
 */
const USUAL_LAG_S = 0.15;
const RAMPED_LAG_S = 0.05;

/**
 * What is assumed of a robot until it is identified: what it says of itself, and for the rest a robot that is rather slow,
 * because who expects too little is never ahead of the robot.
 */
export function usualBase(delayMs: number, ramps: Readonly<BaseRamps> = {}): BaseModel {
  const { accelerationMps2: rise = 0.7, decelerationMps2: fall = 1.5, turnRadps2: turn = 2 } = ramps;
  const lagOf = (known: number | undefined) => (known === undefined ? USUAL_LAG_S : RAMPED_LAG_S);
  return {
    delayMs,
    linear: { gain: 1, lagS: lagOf(ramps.accelerationMps2), rise, fall },
    angular: { gain: 1, lagS: lagOf(ramps.turnRadps2), rise: turn, fall: turn },
  };
}

/** The axis' velocity after `dtS` seconds of this target. @param share `lagShare` of this time: whoever has it gives it */
export function stepAxis(
  velocity: number,
  target: number,
  axis: Readonly<AxisModel>,
  dtS: number,
  share = lagShare(axis, dtS),
): number {
  const difference = target - velocity;
  const slower = velocity * target < 0 || Math.abs(target) < Math.abs(velocity);
  const most = (slower ? axis.fall : axis.rise) * dtS;
  const change = difference * share;
  return velocity + Math.min(Math.max(change, -most), most);
}

/** Which share of its way to the target an axis goes in `dtS` seconds, if nothing but its lag keeps it from it. */
export function lagShare(axis: Readonly<AxisModel>, dtS: number): number {
  return -Math.expm1(-dtS / axis.lagS);
}

/**
 * Lets `dtS` seconds pass, along the chord of the arc. Sideways a base follows its commands as forwards.
 *
 * @param linear and angular, lateral: what the axes approach
 */
export function stepBase(
  motion: BaseMotion,
  model: Readonly<BaseModel>,
  linear: number,
  angular: number,
  dtS: number,
  lateral = 0,
): void {
  const nextLinear = stepAxis(motion.linear, linear, model.linear, dtS);
  const nextAngular = stepAxis(motion.angular, angular, model.angular, dtS);
  const nextLateral = stepAxis(motion.lateral, lateral, model.linear, dtS);
  coast(
    motion,
    (motion.linear + nextLinear) / 2,
    (motion.angular + nextAngular) / 2,
    dtS,
    (motion.lateral + nextLateral) / 2,
  );
  motion.linear = nextLinear;
  motion.angular = nextAngular;
  motion.lateral = nextLateral;
}

/** Moves with a constant velocity for `dtS` seconds, which may be negative. */
export function coast(motion: BaseMotion, linear: number, angular: number, dtS: number, lateral = 0): void {
  const turn = angular * dtS;
  const heading = motion.yaw + turn / 2;
  const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
  motion.x += linear * dtS * cos - lateral * dtS * sin;
  motion.y += linear * dtS * sin + lateral * dtS * cos;
  motion.yaw += turn;
}

export function copyMotion(from: Readonly<BaseMotion>, into: BaseMotion): void {
  into.x = from.x;
  into.y = from.y;
  into.yaw = from.yaw;
  into.linear = from.linear;
  into.lateral = from.lateral;
  into.angular = from.angular;
}

export function standingAt(x = 0, y = 0, yaw = 0): BaseMotion {
  return { x, y, yaw, linear: 0, lateral: 0, angular: 0 };
}
