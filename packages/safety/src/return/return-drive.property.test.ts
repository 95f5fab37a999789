/** For any sequence of drives, losses, stops, faults and times, a robot that comes back by itself keeps every invariant. */
import { casesOf, longProperty } from '@farpoint/network-sim/cases';
import { isZeroTwist, type Twist, zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { FREE } from '../motion/motion-guard.ts';
import type { FloorPose } from '../obstacles/sensor-grid.ts';
import { ReturningRobot, ramps, STEP_MS } from './testing/returning-robot.ts';

const options = {
  afterMs: 3000,
  announceMs: 1000,
  maxM: 5,
  toleranceM: 0.3,
  blockedMs: 4000,
  longestMs: 30_000,
};
const [MAX_LINEAR, MAX_ANGULAR] = [0.2, 0.5];
const EPSILON = 1e-9;
/** What braking from 0.2 m/s takes, and one step. */
const BRAKING_M = 0.02;

/** What happened up to an instant, and the velocities before and at it. */
interface Instant {
  before: Twist;
  after: Twist;
  nowMs: number;
  leased: boolean;
  latched: boolean;
  wheels: boolean;
  odometryMs: number;
  live: boolean;
  seen: boolean;
  held: boolean;
  heardMs: number;
  /** Whether somebody has driven since it last moved by itself and then ended, and since the last emergency stop. */
  mayReturn: boolean;
  /** From the nearest place where it was driven, m. */
  offM: number;
}

const speed = ({ linear, angular }: Twist) => [Math.abs(linear.x), Math.abs(angular.z)] as const;
/** Whether each velocity falls as fast as the ordinary ramps at least, or is zero. */
function brakes({ before, after }: Instant): boolean {
  const [v, w] = speed(after);
  const [v0, w0] = speed(before);
  const s = STEP_MS / 1000;
  const [mostV, mostW] = [v0 - ramps.decelerationMps2 * s, w0 - ramps.turnRadps2 * s];
  return v <= Math.max(0, mostV) + EPSILON && w <= Math.max(0, mostW) + EPSILON;
}

/** They hold at every instant at which nobody holds the lease. */
const invariants: Record<string, (instant: Instant) => boolean> = {
  'it is no faster than a return, or brakes': (instant) => {
    const [v, w] = speed(instant.after);
    return (v <= MAX_LINEAR + EPSILON && w <= MAX_ANGULAR + EPSILON) || brakes(instant);
  },
  'it changes its velocity no faster than the ramps': ({ before, after }) =>
    Math.abs(after.linear.x - before.linear.x) <= (ramps.emergencyMps2 * STEP_MS) / 1000 + EPSILON,
  'while the emergency stop is latched it brakes or stands': (instant) => !instant.latched || brakes(instant),
  'while nothing takes the velocities it brakes or stands': (instant) => instant.wheels || brakes(instant),
  'without fresh odometry it brakes or stands': (instant) =>
    instant.nowMs - instant.odometryMs <= 300 || brakes(instant),
  'while a sensor is silent it brakes or stands': (instant) => instant.live || brakes(instant),
  'where nobody sees it brakes or stands': (instant) => instant.seen || brakes(instant),
  'what a guard holds brakes or stands': (instant) => !instant.held || brakes(instant),
  'until everybody was silent for long enough it brakes or stands': (instant) =>
    instant.nowMs - instant.heardMs >= options.afterMs + options.announceMs || brakes(instant),
  'without a drive before it, it brakes or stands': (instant) => instant.mayReturn || brakes(instant),
  'farther from its track than it may be it brakes or stands': (instant) =>
    instant.offM <= options.toleranceM + BRAKING_M || brakes(instant),
};

type Step =
  | { type: 'drive'; x: number; z: number; seconds: number }
  | { type: 'lose'; seconds: number }
  | { type: 'wait'; seconds: number }
  | { type: 'heard' }
  | { type: 'connect' }
  | { type: 'estop'; latch: boolean }
  | { type: 'spoil'; what: 'wheels' | 'odometry' | 'live' | 'seen' | 'way'; well: boolean }
  | { type: 'push'; y: number }
  | { type: 'press' }
  | { type: 'jump' };

const step: fc.Arbitrary<Step> = fc.oneof(
  {
    weight: 5,
    arbitrary: fc.record({
      type: fc.constant('drive' as const),
      x: fc.constantFrom(0.5, 0.8, 0.3, -0.3, 0),
      z: fc.constantFrom(0, 0, 0.4, -0.8),
      seconds: fc.integer({ min: 1, max: 4 }),
    }),
  },
  {
    weight: 5,
    arbitrary: fc.record({
      type: fc.constant('lose' as const),
      seconds: fc.constantFrom(0, 3.5, 4.5, 4.5, 5),
    }),
  },
  {
    weight: 9,
    arbitrary: fc.record({
      type: fc.constant('wait' as const),
      seconds: fc.double({ min: 0.1, max: 3, noNaN: true }),
    }),
  },
  { weight: 1, arbitrary: fc.constant<Step>({ type: 'heard' }) },
  { weight: 1, arbitrary: fc.constant<Step>({ type: 'connect' }) },
  { weight: 2, arbitrary: fc.record({ type: fc.constant('estop' as const), latch: fc.boolean() }) },
  {
    weight: 4,
    arbitrary: fc.record({
      type: fc.constant('spoil' as const),
      what: fc.constantFrom(
        'wheels' as const,
        'odometry' as const,
        'live' as const,
        'seen' as const,
        'way' as const,
      ),
      well: fc.constantFrom(true, true, false),
    }),
  },
  {
    weight: 1,
    arbitrary: fc.record({
      type: fc.constant('push' as const),
      y: fc.double({ min: -0.04, max: 0.04, noNaN: true }),
    }),
  },
  { weight: 1, arbitrary: fc.constantFrom<Step>({ type: 'jump' }, { type: 'press' }) },
);

/** A robot with a record of what the invariants speak of. */
class Run {
  readonly broken = new Set<string>();
  returned = 0;
  readonly #robot = new ReturningRobot(options);
  #before: Twist = zeroTwist();
  #odometryMs = 0;
  #heardMs = 0;
  #mayReturn = false;
  #driven: FloorPose[] = [];

  constructor() {
    this.#robot.onAdvance = () => this.#look();
    this.#robot.connect();
  }

  take(step: Step): void {
    const robot = this.#robot;
    switch (step.type) {
      case 'drive':
        robot.connect();
        robot.drive(step.x, step.z, step.seconds);
        break;
      case 'lose':
        robot.lose();
        robot.wait(step.seconds);
        break;
      case 'wait':
        robot.wait(step.seconds);
        break;
      case 'heard':
        this.#hear();
        robot.back.heard(robot.nowMs);
        break;
      case 'connect':
        this.#hear();
        robot.connect();
        break;
      case 'estop':
        if (step.latch) robot.guard.holdEstop('key');
        else robot.guard.letGoEstop('key');
        break;
      case 'press':
        robot.guard.holdEstop('gpio');
        robot.wait(0.1);
        robot.guard.letGoEstop('gpio');
        break;
      case 'spoil':
        this.#spoil(step);
        break;
      case 'push':
        robot.base.pose = { ...robot.base.pose, y: robot.base.pose.y + step.y };
        break;
      case 'jump':
        robot.base.pose = { ...robot.base.pose, x: robot.base.pose.x + 3 };
        this.#driven = [];
    }
  }

  #hear(): void {
    this.#heardMs = this.#robot.nowMs;
    if (this.#robot.back.isActive) this.#mayReturn = false;
  }

  #spoil({ what, well }: Extract<Step, { type: 'spoil' }>): void {
    const { lookout } = this.#robot;
    if (what === 'wheels') this.#robot.wheels = well;
    else if (what === 'odometry') this.#robot.odometry = well;
    else if (what === 'live') lookout.isLive = well;
    else if (what === 'seen') lookout.isSeen = well;
    else lookout.says = well ? FREE : { factor: 0, reason: 'obstacle', urgent: true };
  }

  #look(): void {
    const robot = this.#robot;
    const { nowMs, guard, lookout, velocity: after, base } = robot;
    const leased = guard.leaseHolder !== null;
    const { latched } = guard.estopState();
    if (robot.odometry) this.#odometryMs = nowMs;
    if (leased || robot.hand !== null) this.#driven.push({ ...base.pose });
    if (robot.hand !== null) this.#heardMs = nowMs;
    if (!isZeroTwist(guard.velocityAt(nowMs))) this.#mayReturn = true;
    if (latched) this.#mayReturn = false;
    const { x, y } = base.pose;
    const moves = !isZeroTwist(after) && robot.back.phase === 'returning';
    const instant: Instant = {
      ...{ before: this.#before, after, nowMs, leased, latched },
      ...{ wheels: robot.wheels, odometryMs: this.#odometryMs, live: lookout.isLive, seen: lookout.isSeen },
      held: lookout.says.factor === 0,
      heardMs: this.#heardMs,
      mayReturn: this.#mayReturn,
      offM: moves ? Math.min(...this.#driven.map((was) => Math.hypot(was.x - x, was.y - y))) : 0,
    };
    if (!leased)
      for (const [name, holds] of Object.entries(invariants)) if (!holds(instant)) this.broken.add(name);
    if (!leased && moves) this.returned++;
    this.#before = after;
  }
}

describe('a robot that comes back by itself, whatever happens', () => {
  let returned = 0;

  test('satisfies every invariant', () => {
    fc.assert(
      fc.property(fc.array(step, { minLength: 10, maxLength: 60 }), (steps) => {
        const run = new Run();
        for (const each of steps) run.take(each);
        returned += run.returned;
        expect([...run.broken]).toEqual([]);
      }),
      longProperty(19, 600),
    );
  });

  test('and the robot did come back', () => {
    expect(returned).toBeGreaterThan(casesOf(1000));
  });
});
