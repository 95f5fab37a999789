/** How far a robot has driven and for how long, from its telemetry. Pure: by the robot's clock. */
import type { Telemetry } from '@farpoint/protocol';

/**
 * The distance grows in steps of at least this, m. Chosen: above the noise of an odometry that stands, and small enough for a
 * curve; travel.test.ts holds it.
 */
const STEP_M = 0.05;
/** From these speeds on a robot drives, m/s and rad/s. Chosen: above the noise of an odometry that stands; travel.test.ts holds both. */
const MOVING_MPS = 0.02;
const MOVING_RADPS = 0.02;
/**
 * A step that would take more than this share of the robot's limit is no drive but a jump of its localisation, and so is one over
 * this much more, m. Chosen: a robot may be somewhat faster than told, and a correction of some centimetres is in the steps.
 */
const JUMP_SHARE = 1.5;
const JUMP_M = 0.1;
/** Nothing is known of a longer time without telemetry, s: it comes 20 times a second. */
const GAP_S = 1;

type Position = Telemetry['pose']['position'];

export class Travel {
  /** Metres, without jumps. */
  distanceM = 0;
  /** Steps that no drive explains. */
  jumps = 0;
  /** Seconds in which it drove, stood, and said nothing. */
  drivingS = 0;
  standingS = 0;
  unknownS = 0;
  /** Seconds in which it was held, and in which it was slower than it was told to be. */
  heldS = 0;
  slowedS = 0;
  topSpeedMps = 0;
  readonly #maxLinearMps: number;
  #timeMs: number | null = null;
  #last: Position | null = null;
  /** Where the distance was added last. */
  #anchor: Position | null = null;

  /** @param maxLinearMps the robot's limit */
  constructor(maxLinearMps: number) {
    this.#maxLinearMps = maxLinearMps;
  }

  observe(telemetry: Telemetry): void {
    const { timeMs, pose, twist } = telemetry;
    const before = this.#timeMs;
    // It may come out of order.
    if (before !== null && timeMs <= before) return;
    this.#timeMs = timeMs;
    const seconds = before === null ? 0 : (timeMs - before) / 1000;
    const speed = Math.hypot(twist.linear.x, twist.linear.y);
    this.topSpeedMps = Math.max(this.topSpeedMps, speed);
    if (seconds > GAP_S) this.unknownS += seconds;
    else this.#addTime(telemetry, seconds, speed);
    this.#move(pose.position, seconds);
  }

  #addTime({ twist, motion }: Telemetry, seconds: number, speed: number): void {
    if (speed >= MOVING_MPS || Math.abs(twist.angular.z) >= MOVING_RADPS) this.drivingS += seconds;
    else this.standingS += seconds;
    if (motion === undefined || motion.reasons.length === 0) return;
    if (motion.factor === 0) this.heldS += seconds;
    else if (motion.factor < 1) this.slowedS += seconds;
  }

  #move(position: Position, seconds: number): void {
    const last = this.#last;
    this.#last = position;
    if (last === null || this.#anchor === null) {
      this.#anchor = position;
      return;
    }
    if (between(last, position) > JUMP_SHARE * this.#maxLinearMps * seconds + JUMP_M) {
      this.jumps++;
      this.#anchor = position;
      return;
    }
    const step = between(this.#anchor, position);
    if (step < STEP_M) return;
    this.distanceM += step;
    this.#anchor = position;
  }
}

function between(a: Position, b: Position): number {
  return Math.hypot(b.x - a.x, b.y - a.y, b.z - a.z);
}
