/** For any sequence of messages, pictures, faults and times, the velocity for the wheels satisfies every invariant. */
import { type CommandRejection, isZeroTwist, stampUsOf, type Twist, zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { describe, expect, test } from 'vitest';
import { DriveGuard } from '../drive-guard.ts';
import { defaultDriveLimits, RESUME_WITHIN_MS } from '../limits.ts';
import { BlindTravel, blindSpeedMps } from './blind-travel.ts';
import { FREE, type MotionBound, type MotionGuard } from './motion-guard.ts';
import { MotionSupervisor } from './motion-supervisor.ts';
import { ViewAge } from './view-age.ts';

const limits = { ...defaultDriveLimits, maxCommandsPerSecond: 1000 };
const ramps = {
  accelerationMps2: 1,
  decelerationMps2: 2,
  emergencyMps2: 4,
  turnRadps2: 3,
  emergencyTurnRadps2: 6,
};
const view = { slowMs: 250, brakeMs: 400, stallMs: 150, mostM: 0.5, decelerationMps2: 2, radiusM: 0.25 };
/** The interval at which the robot applies the velocity while it moves, ms. */
const STEP_MS = 10;
const EPSILON = 1e-9;

class Sensed implements MotionGuard {
  says: MotionBound = FREE;
  bound(): MotionBound {
    return this.says;
  }
}

/** What happened up to an instant, and the velocities before and at it. */
interface Instant {
  nowMs: number;
  elapsedS: number;
  before: Twist;
  after: Twist;
  /** Of the driver's newest accepted command. */
  commandedMs: number;
  wish: Twist;
  seenMs: number | null;
  worstAgeMs: number | null;
  latched: boolean;
  wheels: boolean;
  held: boolean;
  /** The driver's newest accepted command says that the hand is not read. */
  unread: boolean;
  /** The hand has not let go since a gap that demands it. */
  mustLetGo: boolean;
}

const speed = ({ linear, angular }: Twist) => [Math.abs(linear.x), Math.abs(angular.z)] as const;
const slowsDown = ({ before, after }: Instant) =>
  speed(after).every((v, i) => v <= (speed(before)[i] as number) + EPSILON);

const invariants: Record<string, (instant: Instant) => boolean> = {
  'the velocity stays within the limits, on the axes that the robot has': ({ after }) => {
    const { linear, angular } = after;
    const others = [linear.y, linear.z, angular.x, angular.y];
    const [v, w] = speed(after);
    return v <= limits.maxLinear && w <= limits.maxAngular && others.every((value) => value === 0);
  },
  'it changes no faster than the ramps': ({ before, after, elapsedS }) => {
    const rise = Math.abs(after.linear.x) > Math.abs(before.linear.x);
    const most = rise ? ramps.accelerationMps2 : ramps.emergencyMps2;
    const turned = Math.abs(after.angular.z - before.angular.z);
    return (
      Math.abs(after.linear.x - before.linear.x) <= most * elapsedS + EPSILON &&
      turned <= ramps.emergencyTurnRadps2 * elapsedS + EPSILON
    );
  },
  'after the watchdog’s time without a command it only slows down': (instant) =>
    instant.nowMs - instant.commandedMs < limits.watchdogMs || slowsDown(instant),
  'while the emergency stop is latched it only slows down': (instant) =>
    !instant.latched || slowsDown(instant),
  'while nothing takes the velocities it only slows down': (instant) => instant.wheels || slowsDown(instant),
  'without a picture, or with one that is too old, it only slows down': (instant) => {
    const isSeen = instant.seenMs !== null && instant.nowMs - instant.seenMs < view.brakeMs;
    return isSeen || slowsDown(instant);
  },
  'what a guard holds only slows down': (instant) => !instant.held || slowsDown(instant),
  'a hand that is not read moves nothing': (instant) => !instant.unread || slowsDown(instant),
  'a hand that must let go first moves nothing': (instant) => !instant.mustLetGo || slowsDown(instant),
  'no part gets faster than what blind travel allows': (instant) => {
    if (instant.worstAgeMs === null) return slowsDown(instant);
    const most = blindSpeedMps(instant.worstAgeMs, view);
    const [v, w] = speed(instant.after);
    return v + w * view.radiusM <= most + EPSILON || isSlower(instant);
  },
  'it never goes beyond the wish, unless it comes from there': ({ before, after, wish }) =>
    within(after.linear.x, before.linear.x, wish.linear.x) &&
    within(after.angular.z, before.angular.z, wish.angular.z),
};

/** Linear and angular velocity ramp at rates of their own: neither may grow while their sum is too much. */
function isSlower({ before, after }: Instant): boolean {
  const [v, w] = speed(after);
  const [v0, w0] = speed(before);
  return v + w * view.radiusM <= v0 + w0 * view.radiusM + EPSILON;
}

function within(value: number, before: number, wish: number): boolean {
  return value <= Math.max(before, wish, 0) + EPSILON && value >= Math.min(before, wish, 0) - EPSILON;
}

type Step =
  | { type: 'wait'; ms: number }
  | {
      type: 'command';
      by: 'driver' | 'other';
      x: number;
      z: number;
      deadMan: boolean;
      unread: boolean;
      lateMs: number;
      stamp: boolean;
    }
  | { type: 'picture'; ageMs: number }
  | { type: 'estop' }
  | { type: 'release' }
  | { type: 'wheels'; there: boolean }
  | { type: 'lease'; by: 'driver' | 'other'; take: boolean }
  | { type: 'gone' }
  | { type: 'sense'; factor: number; urgent: boolean };

const signed = (most: number) => fc.double({ min: -most, max: most, noNaN: true });
const driven = fc.record({
  type: fc.constant('command' as const),
  by: fc.constantFrom('driver' as const, 'driver' as const, 'driver' as const, 'other' as const),
  x: signed(limits.maxLinear),
  z: signed(limits.maxAngular),
  deadMan: fc.constantFrom(true, true, true, false),
  unread: fc.constantFrom(false, false, false, false, true),
  lateMs: fc.constantFrom(0, 0, 0, 60, 400),
  stamp: fc.constantFrom(true, true, true, false),
});
const step: fc.Arbitrary<Step> = fc.oneof(
  {
    weight: 8,
    arbitrary: fc.record({ type: fc.constant('wait' as const), ms: fc.integer({ min: 1, max: 60 }) }),
  },
  {
    weight: 1,
    arbitrary: fc.record({ type: fc.constant('wait' as const), ms: fc.integer({ min: 60, max: 900 }) }),
  },
  { weight: 10, arbitrary: driven },
  {
    weight: 6,
    arbitrary: fc.record({ type: fc.constant('picture' as const), ageMs: fc.integer({ min: -5, max: 450 }) }),
  },
  { weight: 1, arbitrary: fc.constantFrom<Step>({ type: 'estop' }, { type: 'release' }, { type: 'gone' }) },
  { weight: 1, arbitrary: fc.record({ type: fc.constant('wheels' as const), there: fc.boolean() }) },
  {
    weight: 1,
    arbitrary: fc.record({
      type: fc.constant('lease' as const),
      by: fc.constantFrom('driver' as const, 'other' as const),
      take: fc.boolean(),
    }),
  },
  {
    weight: 3,
    arbitrary: fc.record({
      type: fc.constant('sense' as const),
      factor: fc.constantFrom(0, 0.3, 0.9, 1),
      urgent: fc.boolean(),
    }),
  },
);

const PASSED_OVER: ReadonlySet<CommandRejection> = new Set([
  'rate-limited',
  'not-lease-holder',
  'repeated',
  'stale',
]);

/** A robot, its operators and the clock, with a record of what the invariants speak of. */
class Run {
  moved = 0;
  readonly broken = new Set<string>();
  readonly #sensed = new Sensed();
  readonly #guard = new DriveGuard({
    limits,
    letGoAfterMs: RESUME_WITHIN_MS,
    takePolicy: 'always',
    randomBytes: (count) => Uint8Array.from({ length: count }, (_, i) => i + this.#handles++),
  });
  readonly #motion: MotionSupervisor;
  #handles = 0;
  #nowMs = 1_000_000;
  #before: Twist = zeroTwist();
  #atMs = this.#nowMs;
  #sequences = { driver: 0, other: 0 };
  #wheels = true;
  #drawnMs: number | null = null;
  #commandedMs = Number.NEGATIVE_INFINITY;
  #wish: Twist = zeroTwist();
  #unread = false;
  #mustLetGo = false;
  /** When motion was last accepted of a hand that has not let go since. */
  #movedMs: number | null = null;
  /** Since when what the driver sees has been too old. */
  #lostMs: number | null = null;

  constructor() {
    this.#guard.watchWheels(() => (this.#wheels ? null : 'gone'));
    this.#motion = new MotionSupervisor(this.#guard, {
      ramps,
      guards: [new ViewAge(this.#guard.view, view), new BlindTravel(this.#guard.view, view), this.#sensed],
      letGoAfter: { 'view-lost': { why: 'what you saw was too old', lastsMs: RESUME_WITHIN_MS } },
    });
    this.#guard.onOpenHand('driver');
    this.#guard.requestLease('driver', false, this.#nowMs);
  }

  take(step: Step): void {
    const guard = this.#guard;
    const driver = guard.leaseHolder;
    this.#happens(step);
    // Another hand.
    if (guard.leaseHolder !== driver) {
      this.#mustLetGo = false;
      this.#movedMs = null;
    }
    if (step.type !== 'wait') this.#look();
  }

  #happens(step: Step): void {
    const guard = this.#guard;
    switch (step.type) {
      case 'wait':
        for (let left = step.ms; left > 0; left -= STEP_MS) {
          this.#nowMs += Math.min(STEP_MS, left);
          this.#look();
        }
        return;
      case 'command':
        this.#command(step);
        break;
      case 'picture':
        this.#drawnMs = this.#nowMs - step.ageMs;
        for (const by of ['driver', 'other']) guard.sentViews.sent(by, this.#drawnMs);
        break;
      case 'estop':
        guard.latchEstop('operator', 'driver');
        break;
      case 'release':
        guard.releaseEstop(guard.leaseHolder ?? '');
        break;
      case 'wheels':
        this.#wheels = step.there;
        break;
      case 'lease':
        guard.requestLease(step.by, step.take, this.#nowMs);
        break;
      case 'gone':
        guard.operatorGone('driver');
        break;
      case 'sense':
        this.#sensed.says =
          step.factor === 1
            ? FREE
            : {
                factor: step.factor,
                reason: step.factor === 0 ? 'obstacle' : 'obstacle-near',
                urgent: step.urgent,
              };
    }
  }

  #command({ by, x, z, deadMan, unread, lateMs, stamp }: Extract<Step, { type: 'command' }>): void {
    const guard = this.#guard;
    const state = guard.leaseState(by);
    const seenUs = stamp && this.#drawnMs !== null ? stampUsOf(this.#drawnMs) : undefined;
    const twist = { ...zeroTwist(), linear: { x, y: 0, z: 0 }, angular: { x: 0, y: 0, z } };
    const moves = deadMan && !unread && !isZeroTwist(twist);
    const isDriver = by === guard.leaseHolder;
    if (isDriver && moves && this.#movedMs !== null && this.#nowMs - this.#movedMs >= RESUME_WITHIN_MS)
      this.#mustLetGo = true;
    const verdict = guard.onCommand(
      by,
      {
        type: 'command',
        sequence: this.#sequences[by]++,
        timeMs: this.#nowMs - lateMs,
        lease: state.lease ?? 'none',
        deadMan,
        ...(unread ? { unread } : {}),
        twist,
        ...(seenUs === undefined ? {} : { seenUs }),
      },
      this.#nowMs,
    );
    // A command that is passed over says nothing about the hand.
    const isHeard = verdict.accepted || !PASSED_OVER.has(verdict.reason);
    if (isDriver && isHeard && !unread && !moves) {
      this.#mustLetGo = false;
      this.#movedMs = null;
    }
    if (!verdict.accepted) return;
    if (moves) this.#movedMs = this.#nowMs - verdict.spentMs;
    this.#commandedMs = this.#nowMs;
    this.#unread = unread;
    this.#wish = unread ? zeroTwist() : twist;
  }

  #look(): void {
    const guard = this.#guard;
    const after = this.#motion.velocityAt(this.#nowMs);
    if (!this.#motion.decision.reasons.includes('view-lost')) this.#lostMs = null;
    else this.#lostMs ??= this.#nowMs;
    if (this.#lostMs !== null && this.#nowMs - this.#lostMs >= RESUME_WITHIN_MS) this.#mustLetGo = true;
    const ageMs = guard.view.ageMs(this.#nowMs);
    const instant: Instant = {
      nowMs: this.#nowMs,
      elapsedS: (this.#nowMs - this.#atMs) / 1000,
      before: this.#before,
      after,
      commandedMs: this.#commandedMs,
      wish: this.#wish,
      seenMs: ageMs === null ? null : this.#nowMs - ageMs,
      worstAgeMs: guard.view.worstAgeMs(this.#nowMs),
      latched: guard.estopState().latched,
      wheels: this.#wheels,
      held: this.#sensed.says.factor === 0,
      unread: this.#unread,
      mustLetGo: this.#mustLetGo,
    };
    for (const [name, holds] of Object.entries(invariants)) if (!holds(instant)) this.broken.add(name);
    if (!isZeroTwist(after)) this.moved++;
    this.#before = after;
    this.#atMs = this.#nowMs;
  }
}

describe('the velocity for the wheels, whatever happens', () => {
  let moved = 0;

  test('satisfies every invariant', () => {
    fc.assert(
      fc.property(fc.array(step, { minLength: 20, maxLength: 150 }), (steps) => {
        const run = new Run();
        for (const each of steps) run.take(each);
        moved += run.moved;
        expect([...run.broken]).toEqual([]);
      }),
      { seed: 19, numRuns: 1500 },
    );
  });

  test('and the robot did move', () => {
    expect(moved).toBeGreaterThan(1000);
  });
});
