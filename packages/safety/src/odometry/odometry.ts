import { shortestTurn, type Twist } from '@farpoint/protocol';
import type { FloorPose } from '../obstacles/sensor-grid.ts';

/** What the robot can do: m/s and rad/s. */
export interface OdometryLimits {
  maxLinear: number;
  /** Sideways; left out: 0. */
  maxLateral?: number | undefined;
  maxAngular: number;
}

/** Where base_link is, how it moves, and when that was measured, robot's clock, ms. */
export interface MeasuredMotion {
  pose: Readonly<FloorPose>;
  /** In base_link; `null` if nobody can tell. */
  twist: Readonly<Twist> | null;
  measuredMs: number;
}

/**
 * Odometry may say that the robot is by so much faster than it is allowed to be. Chosen: it is on a slope,
 * overshoots, or has a wheel that is a little smaller than thought; more is another place.
 */
export const ODOMETRY_OVERSPEED = 1.5;
/**
 * Farther than its speed explains, a pose has jumped: metres, radians. Chosen: two cells of the guard's map,
 * whose obstacles would be wrong by as much; smaller corrections by localisation are common.
 */
const JUMP_M = 0.1;
const JUMP_RAD = 0.1;
/**
 * After a longer silence, any pose is possible, ms. Chosen: what was placed by poses before is older than
 * anything that is driven by.
 */
const MOST_GAP_MS = 2000;
/**
 * A pose that has changed by less has not moved: metres, radians. Chosen: above the jitter of localisation at
 * rest, and a tenth of the way that is waited for; odometry.test.ts holds it and those that follow.
 */
const MOVED_M = 0.01;
const MOVED_RAD = 0.02;
/**
 * A robot that was told to go so far, and for so long at its speed, must have moved: metres, s. What a frozen
 * pose costs: 0.1 m + 0.55 s · speed, and the way to stand (docs/safety.md).
 */
const PATIENCE_M = 0.1;
const PATIENCE_S = 0.5;
/**
 * How far a turn of one radian moves its outline, m. Chosen: a small robot's radius; a larger one is believed
 * a little longer while it turns.
 */
const OUTLINE_M = 0.25;
/**
 * After it has been told to stand for so long, it may try again, ms; with half of the patience each time,
 * four times. Chosen: it has come to rest, and who drives can wait for it (docs/safety.md).
 */
const STANDS_MS = 1000;
const LEAST_PATIENCE = 1 / 16;
/**
 * What says that it moves, m/s and rad/s, and does not, is broken. Chosen: above the noise of a gyroscope and
 * of wheels at rest.
 */
const MOVES = 0.05;
/**
 * A velocity that nobody measures is estimated over such a time, ms. Chosen: a millimetre of noise is 1 cm/s
 * over the shorter one; over the longer one a robot has changed its velocity.
 */
const [LEAST_BASELINE_MS, MOST_BASELINE_MS] = [80, 500];
/** Poses that are kept for that: the longest time, at up to 128 a second. */
const KEPT = 64;

/**
 * What the robot believes about where it is. The obstacle guard, the fence and the way back all ask here, so that none of
 * them believes what another has refused: a pose that does not move although the robot is told to, and one that came
 * before. It also says when a pose has jumped, and estimates a velocity that nobody measures.
 */
export class Odometry {
  readonly #limits: OdometryLimits;
  /** Oldest first. */
  readonly #samples: MeasuredMotion[] = [];
  /** Where it was when it last moved. */
  #anchor: Readonly<FloorPose> | null = null;
  #jumps = 0;
  #jumpedMs = Number.NEGATIVE_INFINITY;
  #told: Readonly<Twist> | null = null;
  #toldMs = 0;
  /** How far it was told to go since it last moved, and for how long, m and s. */
  #toldM = 0;
  #toldS = 0;
  #patience = 1;
  #isStuck = false;
  /** Since when it has been told to stand, ms; `null` while it is told to move. */
  #standsMs: number | null = null;

  constructor(limits: OdometryLimits) {
    this.#limits = limits;
  }

  /**
   * Takes what came. A pose that is not newer than the last changes nothing.
   *
   * @param measuredMs `null` if nobody says where the robot is
   */
  measured(pose: Readonly<FloorPose>, twist: Readonly<Twist> | null, measuredMs: number | null): void {
    if (measuredMs === null || ![pose.x, pose.y, pose.yaw, measuredMs].every(Number.isFinite)) return;
    const last = this.#samples.at(-1);
    if (last !== undefined && measuredMs <= last.measuredMs) return;
    if (last !== undefined && this.#hasJumped(last, pose, measuredMs)) {
      this.#jumps++;
      this.#jumpedMs = measuredMs;
      this.#samples.length = 0;
    }
    const known = twist ?? this.#estimated(pose, measuredMs);
    this.#samples.push({ pose, twist: known, measuredMs });
    if (this.#samples.length > KEPT) this.#samples.shift();
    if (this.#anchor !== null && !hasMoved(this.#anchor, pose)) return;
    this.#anchor = pose;
    this.#toldM = 0;
    this.#toldS = 0;
    this.#patience = 1;
    this.#isStuck = false;
  }

  /** The velocity that the wheels are told from now on. */
  told(twist: Readonly<Twist>, nowMs: number): void {
    const before = this.#told;
    const seconds = Math.max(0, nowMs - this.#toldMs) / 1000;
    if (before !== null && !stands(before)) {
      this.#toldM += pace(before) * seconds;
      this.#toldS += seconds;
    }
    this.#told = twist;
    this.#toldMs = nowMs;
    if (!stands(twist)) this.#standsMs = null;
    else this.#standsMs ??= nowMs;
    const patienceM =
      (PATIENCE_M + PATIENCE_S * (this.#toldS > 0 ? this.#toldM / this.#toldS : 0)) * this.#patience;
    if (this.#anchor !== null && this.#toldM > patienceM) this.#isStuck = true;
    if (this.#isStuck && this.#standsMs !== null && nowMs - this.#standsMs >= STANDS_MS) this.#tryAgain();
  }

  /** What is believed; `null` before the first, and while the pose does not move although the robot is told to. */
  get newest(): MeasuredMotion | null {
    return this.#isStuck ? null : (this.#samples.at(-1) ?? null);
  }

  /** Whether the pose does not move although the robot is told to. */
  get isStuck(): boolean {
    return this.#isStuck;
  }

  /** How often a pose has jumped, and when the last did, ms: what was placed by poses before is somewhere else. */
  get jumps(): { count: number; lastMs: number } {
    return { count: this.#jumps, lastMs: this.#jumpedMs };
  }

  /** The velocity that the wheels were last told. */
  get toldTwist(): Readonly<Twist> | null {
    return this.#told;
  }

  #hasJumped({ pose, measuredMs }: MeasuredMotion, to: Readonly<FloorPose>, atMs: number): boolean {
    const seconds = (atMs - measuredMs) / 1000;
    if (seconds * 1000 > MOST_GAP_MS) return hasMoved(pose, to);
    const { maxLinear, maxLateral = 0, maxAngular } = this.#limits;
    const gone = Math.hypot(to.x - pose.x, to.y - pose.y);
    const turned = Math.abs(shortestTurn(to.yaw - pose.yaw));
    return (
      gone > Math.max(maxLinear, maxLateral) * ODOMETRY_OVERSPEED * seconds + JUMP_M ||
      turned > maxAngular * ODOMETRY_OVERSPEED * seconds + JUMP_RAD
    );
  }

  #estimated(pose: Readonly<FloorPose>, atMs: number): Twist | null {
    const before = this.#samples.findLast(({ measuredMs }) => atMs - measuredMs >= LEAST_BASELINE_MS);
    if (before === undefined || atMs - before.measuredMs > MOST_BASELINE_MS) return null;
    const seconds = (atMs - before.measuredMs) / 1000;
    const turn = shortestTurn(pose.yaw - before.pose.yaw);
    const [dx, dy] = [(pose.x - before.pose.x) / seconds, (pose.y - before.pose.y) / seconds];
    const heading = before.pose.yaw + turn / 2;
    const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
    return {
      linear: { x: dx * cos + dy * sin, y: dy * cos - dx * sin, z: 0 },
      angular: { x: 0, y: 0, z: turn / seconds },
    };
  }

  /** A base that was not ready may be by now. A pose that claims to move is broken. */
  #tryAgain(): void {
    const twist = this.#samples.at(-1)?.twist ?? null;
    if (
      twist !== null &&
      Math.max(Math.hypot(twist.linear.x, twist.linear.y), Math.abs(twist.angular.z)) > MOVES
    )
      return;
    if (this.#patience <= LEAST_PATIENCE) return;
    this.#patience /= 2;
    this.#toldM = 0;
    this.#toldS = 0;
    this.#isStuck = false;
  }
}

function stands({ linear, angular }: Readonly<Twist>): boolean {
  return linear.x === 0 && linear.y === 0 && angular.z === 0;
}

function pace({ linear, angular }: Readonly<Twist>): number {
  return Math.max(Math.hypot(linear.x, linear.y), Math.abs(angular.z) * OUTLINE_M);
}

function hasMoved(from: Readonly<FloorPose>, to: Readonly<FloorPose>): boolean {
  const turned = Math.abs(shortestTurn(to.yaw - from.yaw));
  return Math.hypot(to.x - from.x, to.y - from.y) >= MOVED_M || turned >= MOVED_RAD;
}

/** The short way round. */
