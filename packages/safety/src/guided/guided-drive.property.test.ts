/** For any sequence of goals, holds, velocities, commands, stops and times, a guided robot satisfies every invariant. */
import { goalHasEnded, isZeroTwist, stampUsOf, type Twist, zeroTwist } from '@farpoint/protocol';
import fc from 'fast-check';
import { expect, test } from 'vitest';
import { DriveGuard } from '../drive-guard.ts';
import { defaultDriveLimits } from '../limits.ts';
import { FREE, type MotionBound, type MotionGuard } from '../motion/motion-guard.ts';
import { MotionSupervisor } from '../motion/motion-supervisor.ts';
import { ViewAge } from '../motion/view-age.ts';
import { GuidedDrive } from './guided-drive.ts';
import { defaultGuidedOptions } from './guided-options.ts';

const limits = { ...defaultDriveLimits, maxCommandsPerSecond: 1000 };
const ramps = {
  ...{ accelerationMps2: 1, decelerationMps2: 2, emergencyMps2: 4 },
  ...{ turnRadps2: 3, emergencyTurnRadps2: 6 },
};
const view = { slowMs: 250, brakeMs: 400, stallMs: 150 };
const TICK_MS = 10;
const EPSILON = 1e-9;
type Operator = 'driver' | 'other';

type Step =
  | { type: 'wait'; ms: number; hold: boolean; say: boolean; look: boolean; pose: boolean }
  | { type: 'goal'; by: Operator; x: number }
  | { type: 'hold'; by: Operator; newest: boolean; lateMs: number }
  | { type: 'cancel'; by: Operator }
  | { type: 'say'; x: number; z: number; lateMs: number }
  | { type: 'command'; by: Operator; x: number; deadMan: boolean }
  | { type: 'estop' }
  | { type: 'release' }
  | { type: 'wheels'; there: boolean }
  | { type: 'lease'; by: Operator; take: boolean }
  | { type: 'gone' }
  | { type: 'sense'; factor: number }
  | { type: 'jump' };

const by = fc.constantFrom<Operator>('driver', 'driver', 'driver', 'other');
const mostly = fc.constantFrom(true, true, true, true, true, true, false);
const wild = fc.oneof(
  fc.double({ min: -3, max: 3, noNaN: true }),
  fc.constantFrom(Number.NaN, Number.POSITIVE_INFINITY, 0, 1e308),
);
const kind = <T extends string>(type: T) => ({ type: fc.constant(type) });
const step: fc.Arbitrary<Step> = fc.oneof(
  {
    weight: 14,
    arbitrary: fc.record({
      ...kind('wait'),
      ms: fc.integer({ min: 10, max: 400 }),
      ...{ hold: mostly, say: mostly, look: mostly, pose: mostly },
    }),
  },
  {
    weight: 6,
    arbitrary: fc.record({ ...kind('goal'), by, x: fc.constantFrom(3, 3, 3, 0.1, 50, Number.NaN) }),
  },
  {
    weight: 3,
    arbitrary: fc.record({ ...kind('hold'), by, newest: mostly, lateMs: fc.constantFrom(0, 0, 100, 400) }),
  },
  { weight: 1, arbitrary: fc.record({ ...kind('cancel'), by }) },
  {
    weight: 4,
    arbitrary: fc.record({ ...kind('say'), x: wild, z: wild, lateMs: fc.constantFrom(0, 0, 100, 500) }),
  },
  {
    weight: 2,
    arbitrary: fc.record({ ...kind('command'), by, x: fc.constantFrom(0, 0.4, -0.3), deadMan: mostly }),
  },
  {
    weight: 1,
    arbitrary: fc.constantFrom<Step>(
      ...([
        { type: 'estop' },
        { type: 'release' },
        { type: 'release' },
        { type: 'gone' },
        { type: 'jump' },
      ] as const),
    ),
  },
  { weight: 1, arbitrary: fc.record({ ...kind('wheels'), there: mostly }) },
  { weight: 2, arbitrary: fc.record({ ...kind('lease'), by, take: fc.boolean() }) },
  { weight: 2, arbitrary: fc.record({ ...kind('sense'), factor: fc.constantFrom(0, 0.4, 1, 1, 1) }) },
);

const speed = ({ linear, angular }: Twist) => [Math.abs(linear.x), Math.abs(angular.z)] as const;

class Run {
  moved = 0;
  readonly broken = new Set<string>();
  readonly #guided = new GuidedDrive({ ...defaultGuidedOptions, ...limits });
  #says: MotionBound = FREE;
  readonly #sensed: MotionGuard = { bound: () => this.#says };
  readonly #guard: DriveGuard;
  readonly #motion: MotionSupervisor;
  #handles = 0;
  #nowMs = 1_000_000;
  #atMs = this.#nowMs;
  #before: Twist = zeroTwist();
  #wheels = true;
  #x = 0;
  #sequences = { driver: 0, other: 0 };
  #ids = { driver: 0, other: 0 };
  // What the robot's owner would write down:
  /** Goals that have ended, as operator and number. */
  readonly #ended = new Set<string>();
  #acceptedMs = Number.NEGATIVE_INFINITY;
  #saidMs = Number.NEGATIVE_INFINITY;
  /** Whether the newest thing that the driver asked for with its hand was motion. */
  #byHand = false;

  constructor() {
    this.#guard = new DriveGuard({
      ...{ limits, takePolicy: 'always', guided: this.#guided },
      randomBytes: (count) => Uint8Array.from({ length: count }, (_, i) => i + this.#handles++),
    });
    this.#guard.watchWheels(() => (this.#wheels ? null : 'gone'));
    this.#motion = new MotionSupervisor(this.#guard, {
      ramps,
      guards: [this.#sensed],
      driverGuards: [new ViewAge(this.#guard.view, view)],
    });
    this.#guided.onState = ({ operatorId, id }, state) => {
      const name = `${operatorId} ${id}`;
      if (this.#ended.has(name)) this.broken.add('what has ended begins or ends no more');
      if (goalHasEnded(state)) this.#ended.add(name);
    };
    this.#guard.requestLease('driver', false, this.#nowMs);
    this.#guided.moved({ x: 0, y: 0, yaw: 0 }, this.#nowMs);
  }

  take(each: Step): void {
    const guard = this.#guard;
    switch (each.type) {
      case 'wait':
        for (let left = each.ms; left > 0; left -= TICK_MS) {
          this.#nowMs += TICK_MS;
          this.#x += (this.#before.linear.x * TICK_MS) / 1000;
          if (each.pose) this.#guided.moved({ x: this.#x, y: 0, yaw: 0 }, this.#nowMs);
          if (each.hold) this.#hold(guard.leaseHolder === 'other' ? 'other' : 'driver', true, 0, each.look);
          if (each.say) this.#say(0.5, 0.1, 0);
          this.#look();
        }
        return;
      case 'goal': {
        const goal = { type: 'goal' as const, id: ++this.#ids[each.by], timeMs: this.#nowMs, y: 0 };
        guard.onGoal(each.by, { ...goal, lease: this.#lease(each.by), x: this.#x + each.x }, this.#nowMs);
        break;
      }
      case 'hold':
        this.#hold(each.by, each.newest, each.lateMs, true);
        break;
      case 'cancel':
        guard.onGoalCancel(each.by, this.#ids[each.by]);
        break;
      case 'say':
        this.#say(each.x, each.z, each.lateMs);
        break;
      case 'command':
        this.#command(each);
        break;
      case 'estop':
        guard.latchEstop('operator', 'driver');
        break;
      case 'release':
        guard.releaseEstop(guard.leaseHolder ?? '', this.#nowMs);
        break;
      case 'wheels':
        this.#wheels = each.there;
        break;
      case 'lease':
        guard.requestLease(each.by, each.take, this.#nowMs);
        break;
      case 'gone':
        guard.operatorGone('driver');
        break;
      case 'jump':
        this.#x += 5;
        this.#guided.moved({ x: this.#x, y: 0, yaw: 0 }, this.#nowMs + 1);
        break;
      case 'sense':
        this.#says =
          each.factor === 1 ? FREE : { factor: each.factor, reason: 'obstacle', urgent: each.factor === 0 };
    }
    this.#look();
  }

  #lease(of: Operator): string {
    return this.#guard.leaseState(of).lease ?? 'none';
  }

  #hold(of: Operator, newest: boolean, lateMs: number, look: boolean): void {
    const { accepted } = this.#guard.onGoalHold(
      of,
      {
        ...{ type: 'goalHold', goal: this.#ids[of] - (newest ? 0 : 1), sequence: this.#sequences[of]++ },
        ...{ timeMs: this.#nowMs - lateMs, lease: this.#lease(of) },
        ...(look ? { seenUs: stampUsOf(this.#nowMs - 50) } : {}),
      },
      this.#nowMs,
    );
    if (!accepted) return;
    this.#acceptedMs = this.#nowMs;
    this.#byHand = false;
  }

  #say(x: number, z: number, lateMs: number): void {
    const atMs = this.#nowMs - lateMs;
    this.#guided.navigate({ ...zeroTwist(), linear: { x, y: 0, z: 0 }, angular: { x: 0, y: 0, z } }, atMs);
    this.#saidMs = Math.max(this.#saidMs, atMs);
  }

  #command({ by: of, x, deadMan }: Extract<Step, { type: 'command' }>): void {
    const twist = { ...zeroTwist(), linear: { x, y: 0, z: 0 } };
    const { accepted } = this.#guard.onCommand(
      of,
      {
        ...{ type: 'command', sequence: this.#sequences[of]++, timeMs: this.#nowMs, lease: this.#lease(of) },
        ...{ deadMan, twist, seenUs: stampUsOf(this.#nowMs - 50) },
      },
      this.#nowMs,
    );
    const { goal } = this.#guided;
    if (of === this.#guard.leaseHolder && x !== 0 && goal !== null)
      this.broken.add('a hand on the stick ends the goal');
    if (!accepted) return;
    this.#acceptedMs = this.#nowMs;
    this.#byHand = x !== 0;
  }

  #look(): void {
    const after = this.#motion.velocityAt(this.#nowMs);
    const elapsedS = (this.#nowMs - this.#atMs) / 1000;
    const before = this.#before;
    const slows = speed(after).every((v, i) => v <= (speed(before)[i] as number) + EPSILON);
    const check = (name: string, holds: boolean) => {
      if (!holds) this.broken.add(name);
    };
    const [v, w] = speed(after);
    check('within the limits', v <= limits.maxLinear && w <= limits.maxAngular);
    check(
      'ramped',
      Math.abs(after.linear.x - before.linear.x) <= ramps.emergencyMps2 * elapsedS + EPSILON &&
        Math.abs(after.angular.z - before.angular.z) <= ramps.emergencyTurnRadps2 * elapsedS + EPSILON,
    );
    const guard = this.#guard;
    const wish = guard.velocityAt(this.#nowMs);
    const silentMs = this.#nowMs - this.#acceptedMs;
    check('no wish after silence', silentMs < limits.watchdogMs || isZeroTwist(wish));
    check('only slows after silence', silentMs < limits.watchdogMs || slows);
    check('no wish while latched', !guard.estopState().latched || isZeroTwist(wish));
    check('no wish without wheels', this.#wheels || isZeroTwist(wish));
    check('no wish without a driver', guard.leaseHolder !== null || isZeroTwist(wish));
    check(
      'no goal but of the driver',
      (this.#guided.goal?.operatorId ?? guard.leaseHolder) === guard.leaseHolder,
    );
    check('held: only slows', this.#says.factor > 0 || slows);
    const led = this.#guided.goal !== null;
    check('led or by hand', led || this.#byHand || isZeroTwist(wish));
    const isFresh = this.#nowMs - this.#saidMs < defaultGuidedOptions.navigatorSilentMs;
    check('nothing of an old velocity', !led || this.#byHand || isFresh || isZeroTwist(wish));
    const stands = isZeroTwist(after);
    const stopped = this.#says.factor === 0 && stands && guard.state(this.#nowMs) === 'driving' && led;
    check('what stands held is not led any more', !stopped || isZeroTwist(wish));
    if (led && !stands) this.moved++;
    this.#before = after;
    this.#atMs = this.#nowMs;
  }
}

let moved = 0;

test('a guided robot satisfies every invariant, whatever happens', () => {
  fc.assert(
    fc.property(fc.array(step, { minLength: 20, maxLength: 100, size: 'max' }), (steps) => {
      const run = new Run();
      for (const each of steps) run.take(each);
      moved += run.moved;
      expect([...run.broken]).toEqual([]);
    }),
    { seed: 23, numRuns: 800 },
  );
});

test('and it did drive to goals', () => {
  expect(moved).toBeGreaterThan(1000);
});
