import { type Command, type Twist, zeroTwist } from '@farpoint/protocol';
import { DriveGuard } from '../../drive-guard.ts';
import { defaultDriveLimits } from '../../limits.ts';
import { FREE, type MotionBound, type MotionGuard } from '../../motion/motion-guard.ts';
import { MotionSupervisor } from '../../motion/motion-supervisor.ts';
import { type Lookout, ReturnDrive } from '../return-drive.ts';
import { defaultReturnOptions, type ReturnOptions } from '../return-options.ts';
import { Unicycle } from './unicycle.ts';

export const STEP_MS = 20;
export const ramps = {
  accelerationMps2: 1,
  decelerationMps2: 2,
  emergencyMps2: 4,
  turnRadps2: 3,
  emergencyTurnRadps2: 6,
};

/** What a test says that the sensors say. */
export class ToldLookout implements Lookout, MotionGuard {
  isLive = true;
  isSeen = true;
  says: MotionBound = FREE;
  live(): boolean {
    return this.isLive;
  }
  sees(): boolean {
    return this.isSeen;
  }
  bound(): MotionBound {
    return this.says;
  }
}

/** A robot in simulated time that drives back by itself, under the real guard and supervisor. */
export class ReturningRobot {
  readonly lookout = new ToldLookout();
  readonly guard: DriveGuard;
  readonly back: ReturnDrive;
  readonly motion: MotionSupervisor;
  readonly base = new Unicycle();
  nowMs = 100_000;
  velocity: Twist = zeroTwist();
  wheels = true;
  odometry = true;
  /** What the driver's hand asks for; `null`: it says nothing. */
  hand: { x: number; z: number } | null = null;
  /** Called after each step. */
  onAdvance: (() => void) | null = null;
  #lease = '';
  #sequence = 0;

  constructor(options: Partial<ReturnOptions> = {}, lookout?: Lookout & MotionGuard) {
    const limits = { ...defaultDriveLimits, maxCommandsPerSecond: 1000 };
    this.guard = new DriveGuard({ limits, randomBytes: (count) => new Uint8Array(count) });
    this.guard.watchWheels(() => (this.wheels ? null : 'gone'));
    const looks = lookout ?? this.lookout;
    this.back = new ReturnDrive(
      { ...defaultReturnOptions, ...options },
      { mostMps: limits.maxLinear * 1.5, mostRadps: limits.maxAngular * 1.5 },
      looks,
    );
    // A driver who sees nothing must not keep the robot from coming back.
    const blind: MotionGuard = {
      bound: () =>
        this.guard.leaseHolder === null ? { factor: 0, reason: 'view-lost', urgent: true } : FREE,
    };
    this.motion = new MotionSupervisor(this.guard, {
      ...{ ramps, guards: [looks], driverGuards: [blind], unattended: this.back },
    });
    this.advance();
  }

  /** A driver takes the lease. */
  connect(): void {
    this.back.heard(this.nowMs);
    this.guard.onOpenHand('driver');
    const outcome = this.guard.requestLease('driver', true, this.nowMs);
    if (outcome.granted) this.#lease = outcome.lease;
  }

  /** The driver's link is lost, and with it the lease. */
  lose(): void {
    this.hand = null;
    this.guard.operatorGone('driver');
  }

  /** One step. */
  advance(): void {
    this.base.go(this.velocity, STEP_MS / 1000);
    this.nowMs += STEP_MS;
    if (this.odometry) this.back.moved(this.base.pose, this.nowMs);
    if (this.hand !== null) {
      this.back.heard(this.nowMs);
      this.guard.onCommand('driver', this.#command(this.hand), this.nowMs);
    }
    this.velocity = this.motion.velocityAt(this.nowMs);
    this.onAdvance?.();
  }

  wait(seconds: number): void {
    for (let i = 0; i < Math.round((seconds * 1000) / STEP_MS); i++) this.advance();
  }

  drive(x: number, z: number, seconds: number): void {
    this.hand = { x, z };
    this.wait(seconds);
    this.hand = { x: 0, z: 0 };
    this.wait(0.5);
  }

  #command({ x, z }: { x: number; z: number }): Command {
    const twist = { ...zeroTwist(), linear: { x, y: 0, z: 0 }, angular: { x: 0, y: 0, z } };
    const sequence = this.#sequence++;
    return { type: 'command', sequence, timeMs: this.nowMs, lease: this.#lease, deadMan: true, twist };
  }
}
