import { shortestTurn, type Twist, zeroTwist } from '@farpoint/protocol';
import type { FloorPose } from '../obstacles/sensor-grid.ts';
import type { Crumb, Track } from './track.ts';

export interface FollowerLimits {
  /** m/s and rad/s. */
  maxLinear: number;
  maxAngular: number;
  /** m. */
  toleranceM: number;
}

/** How the robot goes from one crumb to the one before it. */
interface Leg {
  from: Crumb;
  to: Crumb;
  /** m. */
  length: number;
  /** 1: forwards, because it came in reverse; −1: backwards; 0: it turns on the spot. */
  direction: -1 | 0 | 1;
}

// track-follower.test.ts drives random ways with these numbers, with turns on the spot and in reverse.

/** It steers for the point that is so far along its track; in bends for a nearer one, m. */
const MOST_LOOKAHEAD_M = 0.3;
const LOOKAHEADS_M = [MOST_LOOKAHEAD_M, 0.15, 0.08];
/** A shorter leg with a turn is a turn on the spot. */
const SPOT_M = 0.03;
const SPOT_RAD = 0.05;
/** Nearer to the end of a leg it is there, m and rad. */
const THERE_M = 0.03;
const THERE_RAD = 0.06;
/** Where all of these are off by more than this, it turns before it drives, rad. */
const ASKEW_RAD = 0.6;
/** Least speed before a stop, m/s; least rate of turning, rad/s. */
const CREEP_MPS = 0.05;
const CREEP_RADPS = 0.1;
/** Rate of turning for an angle that is left, 1/s. */
const TURN_GAIN = 1.5;

/**
 * Leads the robot back along its track: the way on which it came, in the opposite direction, with the same side ahead. It steers for
 * a point a little ahead on the track (pure pursuit), but never past a place where the robot turned on the spot or changed
 * its direction.
 */
export class TrackFollower {
  readonly #track: Track;
  readonly #limits: Readonly<FollowerLimits>;

  constructor(track: Track, limits: FollowerLimits) {
    this.#track = track;
    this.#limits = Object.freeze({ ...limits });
  }

  /** The next velocity. Crumbs that the robot has reached are passed. */
  step(pose: Readonly<FloorPose>): Twist | 'arrived' | 'off-track' {
    for (;;) {
      const leg = this.#leg(0);
      if (leg === null) return 'arrived';
      if (!(distanceTo(leg, pose) <= this.#limits.toleranceM)) return 'off-track';
      if (!isDone(leg, pose)) return leg.direction === 0 ? this.#turn(leg, pose) : this.#pursue(leg, pose);
      this.#track.pass();
    }
  }

  /** @param ahead 0: the present leg; `null` if there is none */
  #leg(ahead: number): Leg | null {
    const { crumbs } = this.#track;
    const from = crumbs[crumbs.length - 1 - ahead];
    const to = crumbs[crumbs.length - 2 - ahead];
    return from === undefined || to === undefined ? null : legBetween(from, to);
  }

  #turn({ to }: Leg, { yaw }: Readonly<FloorPose>): Twist {
    return this.#turnBy(shortestTurn(to.yaw - yaw));
  }

  #turnBy(angle: number): Twist {
    const rate = Math.min(this.#limits.maxAngular, Math.max(CREEP_RADPS, Math.abs(angle) * TURN_GAIN));
    const twist = zeroTwist();
    twist.angular.z = Math.sign(angle) * rate;
    return twist;
  }

  #pursue(leg: Leg, pose: Readonly<FloorPose>): Twist {
    const [cos, sin] = [Math.cos(pose.yaw), Math.sin(pose.yaw)];
    let askew = 0;
    for (const lookahead of LOOKAHEADS_M) {
      const { x, y, left } = this.#aim(leg, pose, lookahead);
      const ahead = (x - pose.x) * cos + (y - pose.y) * sin;
      const aside = (y - pose.y) * cos - (x - pose.x) * sin;
      // With its back to the aim if it goes backwards.
      askew = Math.atan2(aside * leg.direction, ahead * leg.direction);
      if (Math.abs(askew) > ASKEW_RAD) continue;
      // The arc through the aim that begins along the robot's heading.
      return this.#drive(leg, (2 * aside) / (ahead * ahead + aside * aside), left);
    }
    return this.#turnBy(askew);
  }

  /** @param bend of the arc, rad/m @param left until it must stop, m */
  #drive({ direction }: Leg, bend: number, left: number): Twist {
    const { maxLinear, maxAngular } = this.#limits;
    const most = Math.min(maxLinear, Math.max(CREEP_MPS, left));
    const speed = Math.abs(bend) * most > maxAngular ? maxAngular / Math.abs(bend) : most;
    const twist = zeroTwist();
    twist.linear.x = direction * speed;
    twist.angular.z = direction * speed * bend;
    return twist;
  }

  /** The point to steer for, and how far the robot goes on in this direction, m: as far as it looks. */
  #aim(present: Leg, pose: Readonly<FloorPose>, lookahead: number): { x: number; y: number; left: number } {
    let along = Math.max(0, alongOf(present, pose));
    let left = 0;
    let leg = present;
    for (let ahead = 1; ; ahead++) {
      const rest = leg.length - along;
      if (left + rest >= lookahead) {
        return { ...between(leg, (along + lookahead - left) / leg.length), left: MOST_LOOKAHEAD_M };
      }
      left += rest;
      const next = this.#leg(ahead);
      if (next === null || next.direction !== present.direction) return { ...beyond(leg, lookahead), left };
      leg = next;
      along = 0;
    }
  }
}

function legBetween(from: Crumb, to: Crumb): Leg {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const length = Math.hypot(dx, dy);
  const turn = shortestTurn(to.yaw - from.yaw);
  if (length < SPOT_M && Math.abs(turn) > SPOT_RAD) return { from, to, length, direction: 0 };
  const heading = from.yaw + turn / 2;
  const isAhead = dx * Math.cos(heading) + dy * Math.sin(heading) > 0;
  return { from, to, length, direction: isAhead ? 1 : -1 };
}

/** How far the robot has come on a leg, m. */
function alongOf({ from, to, length }: Leg, { x, y }: Readonly<FloorPose>): number {
  if (length === 0) return 0;
  return ((x - from.x) * (to.x - from.x) + (y - from.y) * (to.y - from.y)) / length;
}

function isDone(leg: Leg, pose: Readonly<FloorPose>): boolean {
  if (leg.direction === 0) return Math.abs(shortestTurn(leg.to.yaw - pose.yaw)) < THERE_RAD;
  return alongOf(leg, pose) >= leg.length - THERE_M;
}

function distanceTo(leg: Leg, pose: Readonly<FloorPose>): number {
  const share = leg.length === 0 ? 0 : Math.min(1, Math.max(0, alongOf(leg, pose) / leg.length));
  const { x, y } = between(leg, share);
  return Math.hypot(pose.x - x, pose.y - y);
}

function between({ from, to }: Leg, share: number): { x: number; y: number } {
  return { x: from.x + (to.x - from.x) * share, y: from.y + (to.y - from.y) * share };
}

/** A little farther than its end, so that the aim never lies beside the robot. */
function beyond(leg: Leg, by: number): { x: number; y: number } {
  return leg.length === 0 ? { x: leg.to.x, y: leg.to.y } : between(leg, 1 + by / leg.length);
}
