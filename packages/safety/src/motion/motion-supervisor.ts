import { type Intervention, isZeroTwist, type Twist, zeroTwist } from '@farpoint/protocol';
import type { DriveGuard } from '../drive-guard.ts';
import type { MotionGuard } from './motion-guard.ts';
import type { UnattendedDrive } from './unattended-drive.ts';
import { NO_RAMPS, type RampLimits, VelocityRamp } from './velocity-ramp.ts';

/** What the robot does (docs/safety.md draws the transitions). */
export type MotionPhase =
  | 'standing' // nothing asks for motion
  | 'driving' // it follows the driver or its own way back, or ramps towards what is asked
  | 'limited' // it follows more slowly than asked
  | 'braking' // it slows down to stand still
  | 'held' // it stands still although the driver asks for motion
  | 'latched'; // the emergency stop is latched, and it stands still

/** What the supervisor has made of the latest wish. */
export interface MotionDecision {
  phase: MotionPhase;
  /** Share of the requested velocity that is let through, 0 to 1; 1 while nothing is requested. */
  factor: number;
  /** Why it is less than 1, the strictest first; the same array while nothing changes. */
  reasons: readonly Intervention[];
}

export interface MotionSupervisorOptions {
  /** Bounds on motion; the strictest counts. */
  guards?: readonly MotionGuard[];
  /** Further bounds on what a driver asks for: what follows from what it sees. */
  driverGuards?: readonly MotionGuard[];
  /** Moves the robot while no driver does. */
  unattended?: UnattendedDrive | null;
  ramps?: RampLimits;
  /** Wheels that are told nothing for this long stop by themselves, ms; default the watchdog's time. */
  staleMs?: number;
  /** After one of these has kept the robot from moving for a while, the hand must let go before it moves again. */
  letGoAfter?: Readonly<Partial<Record<Intervention, LetGoDemand>>>;
}

export interface LetGoDemand {
  /** For people, completes "held while …", under 100 characters. */
  why: string;
  /** For how long it must last, ms; 0: at once. */
  lastsMs: number;
}

const NONE: readonly Intervention[] = Object.freeze([]);

/**
 * Has the last word on the robot's velocity: what the drive guard lets through, bounded by the strictest of the motion
 * guards, ramped. Times are the robot's monotonic clock in ms.
 *
 * While no driver moves the robot, nobody holds the lease, no emergency stop is latched and something takes the velocities,
 * an unattended drive may; when it ends, the robot brakes as hard as allowed.
 *
 * These invariants hold for any sequence of calls:
 * - no component of the velocity exceeds that of the wish, except while the ramp leads it there;
 * - the velocity changes no faster than the ramps allow, and goes towards zero from the moment that anything demands a
 *   stop, however the wish changes;
 * - linear and angular velocity, forwards and sideways, are bounded alike: the robot leaves its arc only while it ramps;
 * - the planar velocity never exceeds both what it was and the wish's, and a robot that brakes to stand keeps its direction.
 */
export class MotionSupervisor {
  readonly guard: DriveGuard;
  /** Called at the beginning of each intervention. */
  onIntervention: ((reason: Intervention, nowMs: number) => void) | null = null;
  /** For a driver's wish, and for others. */
  readonly #allGuards: readonly MotionGuard[];
  readonly #guards: readonly MotionGuard[];
  readonly #unattended: UnattendedDrive | null;
  /** Whether an unattended drive gave the robot the velocity that it has. */
  #unattendedMoves = false;
  readonly #ramp: VelocityRamp;
  readonly #letGoAfter: ReadonlyMap<Intervention, LetGoDemand>;
  /** Since when those of them have lasted that last now, ms. */
  readonly #lasts = new Map<Intervention, number>();
  #phase: MotionPhase = 'standing';
  #factor = 1;
  #reasons: readonly Intervention[] = NONE;
  #ramping = false;
  /** What made the driver's hand let go first, as long as it has not. */
  #stopped: Intervention | null = null;

  constructor(guard: DriveGuard, options: MotionSupervisorOptions = {}) {
    this.guard = guard;
    this.#guards = options.guards ?? [];
    this.#allGuards = [...(options.driverGuards ?? []), ...this.#guards];
    this.#unattended = options.unattended ?? null;
    this.#ramp = new VelocityRamp(options.ramps ?? NO_RAMPS, options.staleMs ?? guard.limits.watchdogMs);
    this.#letGoAfter = new Map(Object.entries(options.letGoAfter ?? {}) as [Intervention, LetGoDemand][]);
    guard.watchMotion(() => this.#ramp.stands);
  }

  /** The velocity for the wheels now. Call it at every change of the guard, and at short intervals while {@link ramping}. */
  velocityAt(nowMs: number): Twist {
    // Before the wish is read: asking for it may halt the guard.
    const wish = this.guard.velocityAt(nowMs);
    const own = this.#unattendedWish(!isZeroTwist(wish), nowMs);
    const asked = own ?? wish;
    const moving = !isZeroTwist(asked);
    // Also for a wish to stand still: the ordinary ramp may take too long for a guard.
    const bounds = this.#ask(asked, own === null ? this.#allGuards : this.#guards, nowMs);
    const found = moving ? bounds : null;
    const factor = found?.factor ?? 1;
    const stops = !moving && (this.#unattendedMoves || this.guard.stopsUrgently(nowMs));
    const urgent = bounds?.urgent === true || stops;
    const target = scaled(asked, factor);
    const twist = this.#ramp.step(target, urgent, nowMs);
    this.#ramping = this.#ramp.differs(target);
    this.#unattendedMoves = moving ? own !== null : this.#unattendedMoves && !isZeroTwist(twist);
    if (moving) this.#stopped = null;
    this.#tell(found?.reasons ?? this.#lasting(), nowMs);
    if (this.#letGoAfter.size > 0) this.#demand(found?.reasons ?? NONE, nowMs);
    this.#decide(moving || this.#stopped !== null, factor, isZeroTwist(twist), isZeroTwist(target));
    return twist;
  }

  /** Whether the velocity is on its way to its target. */
  get ramping(): boolean {
    return this.#ramping;
  }

  /** What became of the wish at the latest {@link velocityAt}. */
  get decision(): MotionDecision {
    return { phase: this.#phase, factor: this.#factor, reasons: this.#reasons };
  }

  /** Stands still at once, without a ramp. */
  halt(): void {
    this.#ramp.stop();
    this.#ramping = false;
  }

  #unattendedWish(driven: boolean, nowMs: number): Twist | null {
    if (this.#unattended === null) return null;
    const { leaseHolder, hasWheels } = this.guard;
    const { latched } = this.guard.estopState();
    const leased = leaseHolder !== null;
    const wish = this.#unattended.wishAt(nowMs, { driven, leased, latched, wheels: hasWheels });
    return driven || leased || latched || !hasWheels ? null : wish;
  }

  #ask(
    asked: Twist,
    guards: readonly MotionGuard[],
    nowMs: number,
  ): { factor: number; urgent: boolean; reasons: Intervention[] } | null {
    let factor = 1;
    let urgent = false;
    let reasons: Intervention[] | null = null;
    for (const each of guards) {
      const bound = each.bound(asked, nowMs);
      if (bound.reason === null) continue;
      // A guard that fails to count must not set the robot free.
      const share = bound.factor >= 0 && bound.factor <= 1 ? bound.factor : 0;
      urgent ||= bound.urgent;
      reasons ??= [];
      if (share < factor) reasons.unshift(bound.reason);
      else reasons.push(bound.reason);
      factor = Math.min(factor, share);
    }
    return reasons === null ? null : { factor, urgent, reasons };
  }

  /** An intervention lasts until the hand that it demands has let go. */
  #lasting(): readonly Intervention[] {
    if (this.#stopped === null) return NONE;
    if (this.guard.awaitsLetGo) return this.#reasons;
    this.#stopped = null;
    return NONE;
  }

  #decide(moving: boolean, factor: number, stands: boolean, mayNotMove: boolean): void {
    this.#factor = this.#stopped === null ? factor : 0;
    if (mayNotMove && !stands) this.#phase = 'braking';
    else if (this.guard.estopState().latched) this.#phase = 'latched';
    else if (!moving) this.#phase = 'standing';
    else if (mayNotMove) this.#phase = 'held';
    else this.#phase = factor < 1 ? 'limited' : 'driving';
  }

  #tell(reasons: readonly Intervention[], nowMs: number): void {
    const before = this.#reasons;
    const isSame = before.length === reasons.length && before.every((reason, i) => reason === reasons[i]);
    if (isSame) return;
    this.#reasons = reasons;
    for (const reason of reasons) if (!before.includes(reason)) this.onIntervention?.(reason, nowMs);
  }

  #demand(reasons: readonly Intervention[], nowMs: number): void {
    for (const [reason, { why, lastsMs }] of this.#letGoAfter) {
      if (!reasons.includes(reason)) {
        this.#lasts.delete(reason);
        continue;
      }
      const sinceMs = this.#lasts.get(reason) ?? nowMs;
      this.#lasts.set(reason, sinceMs);
      if (nowMs - sinceMs < lastsMs) continue;
      this.guard.demandLetGo(why);
      this.#stopped = reason;
    }
  }
}

function scaled({ linear, angular }: Twist, factor: number): Twist {
  const twist = zeroTwist();
  twist.linear.x = linear.x * factor + 0;
  twist.linear.y = linear.y * factor + 0;
  twist.angular.z = angular.z * factor + 0;
  return twist;
}
