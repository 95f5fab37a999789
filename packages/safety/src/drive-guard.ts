import {
  type Command,
  type DriveLimits,
  type DriveState,
  type EstopCause,
  type EstopReleasePolicy,
  type EstopState,
  isZeroTwist,
  type LeaseState,
  type RobotStop,
  type Twist,
  zeroTwist,
} from '@farpoint/protocol';
import {
  CommandGate,
  type CommandGateOptions,
  type CommandVerdict,
  type RejectedCommand,
  WITHOUT_WHEELS,
} from './command-gate.ts';
import { EstopLatch, type EstopSource } from './estop.ts';
import { causeOf, type EstopReleaseOutcome, releaseEstop } from './estop-release.ts';
import { type LeaseOptions, type LeaseOutcome, LeaseTable } from './lease.ts';
import { copyTwist } from './limits.ts';
import { OperatorView } from './motion/operator-view.ts';
import { SentViews } from './motion/sent-views.ts';
import { Watchdog } from './watchdog.ts';

export interface DriveGuardOptions extends LeaseOptions, CommandGateOptions {
  limits: DriveLimits;
  /** Who may release what an operator has latched; default `driver`. */
  estopRelease?: EstopReleasePolicy | undefined;
}

/**
 * Everything between the operators' messages and the robot's wheels. All times are the robot's monotonic clock in ms.
 *
 * These invariants hold for any sequence of calls:
 * - `velocityAt` stays within the limits given at construction, which nothing can change;
 * - it is zero `watchdogMs` after the last accepted command, while the emergency stop is latched, and while nobody
 *   holds the lease;
 * - it follows the commands of the lease holder and of nobody else;
 * - it is zero while nothing takes it ({@link DriveGuard.watchWheels});
 * - a hand that is not known to have been open since it began to drive, or since the emergency stop was released, moves
 *   nothing; nor does one to which another hand gave the drive, until it was seen open while the robot stood;
 * - a request from before an emergency stop, a change of the lease, a fault of the wheels or a released grip never
 *   takes effect again.
 */
export class DriveGuard {
  /** How old what the driver sees is. */
  readonly view: OperatorView;
  /** What each operator was sent, which its commands may name as seen. */
  readonly sentViews = new SentViews();
  /** The operator is this subject: what any of its sessions latches, each of them has latched. */
  readonly identify = (id: string, subject: string) => this.#estop.latchers.identify(id, subject);
  readonly #limits: Readonly<DriveLimits>;
  readonly #gate: CommandGate;
  readonly #leases: LeaseTable;
  readonly #estop: EstopLatch;
  readonly #estopRelease: EstopReleasePolicy;
  readonly #watchdog: Watchdog;
  #wish: Twist = zeroTwist();
  #askWheels: () => string | null = () => null;
  #stands: () => boolean = () => true;
  #hadWheels = true;
  /** Whether something other than the driver's wish has stopped the robot. */
  #forced = false;

  constructor(options: DriveGuardOptions) {
    this.#limits = Object.freeze({ ...options.limits });
    this.#gate = new CommandGate(this.#limits, options);
    this.#leases = new LeaseTable(options);
    this.#estop = new EstopLatch();
    this.#estopRelease = options.estopRelease ?? 'driver';
    this.#watchdog = new Watchdog(this.#limits.watchdogMs);
    this.view = new OperatorView(this.#limits.watchdogMs);
  }

  /** Frozen. */
  get limits(): Readonly<DriveLimits> {
    return this.#limits;
  }

  /**
   * Judges a command. An accepted command sets the velocity until the next one, or until the watchdog expires.
   * `nextDeadlineMs` changes with every call.
   */
  onCommand(operatorId: string, command: Command, nowMs: number): CommandVerdict {
    const wheelsFault = this.#lookAtWheels();
    const verdict = this.#gate.check(operatorId, command, nowMs, {
      holdsLease: this.#leases.holds(operatorId, command.lease),
      meetEstop: (motion) => this.#estop.meet(motion),
      wheelsFault,
      stands: this.#stands(),
    });
    if (verdict.accepted) {
      this.view.note(this.sentViews.ageMs(operatorId, command.seenUs, nowMs), nowMs);
      if (verdict.unread) {
        this.#halt();
        return verdict;
      }
      this.#wish = verdict.twist;
      this.#forced = false;
      // What was read a while ago is valid for so much less.
      this.#watchdog.feed(nowMs - verdict.spentMs);
      if (!isZeroTwist(verdict.twist)) this.#leases.noteMotion(nowMs);
      return { ...verdict, twist: copyTwist(verdict.twist) };
    }
    // The gate gives this reason only for the holder's latest request: the grip was released, so stop now, not in 150
    // ms.
    if (verdict.reason === 'dead-man-released') this.#halt();
    return verdict;
  }

  /** An operator's hand is open, by what its protocol says without a command for zero or with an open grip. */
  onOpenHand(operatorId: string): void {
    this.#gate.opens(operatorId);
    if (this.#leases.holder === operatorId) this.#estop.meet(false);
  }

  /** A message that should have been a command but could not be decoded. It counts against the operator's rate. */
  onMalformed(operatorId: string, detail: string, nowMs: number): RejectedCommand {
    return this.#gate.malformed(operatorId, detail, nowMs);
  }

  /** For each clock probe: teaches the gate this path's transit time, so that it can tell stale from fresh at once. */
  onClockProbe(operatorId: string, sentMs: number, nowMs: number): void {
    this.#gate.observeClock(operatorId, sentMs, nowMs);
  }

  /** @param sentMs the operator's clock @returns how much longer than usual the message was under way, ms */
  lateMs(operatorId: string, sentMs: number, nowMs: number): number {
    return this.#gate.observeClock(operatorId, sentMs, nowMs);
  }

  /** A picture or cloud was sent to the operator. */
  onViewSent(operatorId: string, nowMs: number): void {
    if (this.#leases.holder === operatorId) this.view.sent(nowMs);
  }

  /**
   * From now on motion is refused while nothing takes the velocities. A hand that held on meanwhile must let go once
   * before they move anything again.
   *
   * @param fault asked at each command and velocity: why nothing takes them, for people, under 200 characters; `null`
   * if something does
   */
  watchWheels(fault: () => string | null): void {
    this.#askWheels = fault;
  }

  /** @param stands asked at each command: whether the robot stands still, as far as its wheels were told */
  watchMotion(stands: () => boolean): void {
    this.#stands = stands;
  }

  /** Whether something takes the velocities, as {@link velocityAt} found last. */
  get hasWheels(): boolean {
    return this.#hadWheels;
  }

  /**
   * Whoever moves the robot now must let go once before it moves again.
   *
   * @param why for people, completes "held while …", under 100 characters
   */
  demandLetGo(why: string): void {
    this.#halt();
    this.#gate.requireLetGo(why);
  }

  /** The velocity that the driver asks for now, within the limits, as a copy. */
  velocityAt(nowMs: number): Twist {
    this.#lookAtWheels();
    const moving = this.#leases.holder !== null && !this.#estop.latched && !this.#watchdog.expired(nowMs);
    return moving ? copyTwist(this.#wish) : zeroTwist();
  }

  /** Whether something other than the driver's wish makes `velocityAt` zero: brake as hard as allowed. */
  stopsUrgently(nowMs: number): boolean {
    if (this.#forced || this.#estop.latched) return true;
    return !isZeroTwist(this.#wish) && this.#watchdog.expired(nowMs);
  }

  /** Whether the robot would refuse its driver's motion until the hand has let go once. */
  mustLetGo(nowMs: number): boolean {
    const { holder } = this.#leases;
    return holder !== null && this.#gate.mustLetGo(holder, nowMs);
  }

  /** Whether {@link demandLetGo}, or a {@link handOver}, still keeps the robot from moving. */
  get awaitsLetGo(): boolean {
    const { holder } = this.#leases;
    return holder !== null && this.#gate.awaitsLetGo(holder);
  }

  /** When `velocityAt` becomes zero without any further call: arm a timer for it. `null` while the velocity is zero. */
  get nextDeadlineMs(): number | null {
    return isZeroTwist(this.#wish) ? null : this.#watchdog.deadlineMs;
  }

  /** @param blocked whether the robot senses an obstacle */
  state(nowMs: number, blocked = false): DriveState {
    if (this.#estop.latched) return 'estop';
    if (this.#leases.holder === null || isZeroTwist(this.#wish)) return 'idle';
    if (this.#watchdog.expired(nowMs)) return 'watchdog';
    return blocked ? 'blocked' : 'driving';
  }

  /** The operator that holds the lease. */
  get leaseHolder(): string | null {
    return this.#leases.holder;
  }

  /**
   * After a grant, send every operator its `leaseState`.
   *
   * @param supervises whether the operator may take the lease from whoever has it
   */
  requestLease(operatorId: string, take: boolean, nowMs: number, supervises = false): LeaseOutcome {
    const before = this.#leases.holder;
    const outcome = this.#leases.request(operatorId, take, nowMs, supervises);
    if (!outcome.granted) this.#gate.asksInVain(operatorId);
    if (this.#leases.holder === before) return outcome;
    this.#changeDriver();
    this.#gate.takesOver(operatorId);
    return outcome;
  }

  /**
   * The driver hands the lease to another operator. The robot brakes at once, and stands until the new driver has shown an
   * open grip after that: a hand that is on the stick already moves nothing. Then send every operator its `leaseState`.
   *
   * @returns false if `from` does not drive, or is `to`; then nothing has changed
   */
  handOver(from: string, to: string, nowMs: number): boolean {
    if (!this.#leases.handOver(from, to, nowMs)) return false;
    this.#changeDriver();
    this.#gate.requireOpenGrip(to);
    return true;
  }

  /** @returns whether the operator held the lease; if so, send every operator its `leaseState` */
  releaseLease(operatorId: string): boolean {
    const released = this.#leases.release(operatorId);
    if (released) this.#changeDriver();
    return released;
  }

  /** The operator's connection has ended. @returns whether this freed the lease */
  operatorGone(operatorId: string): boolean {
    this.#gate.forget(operatorId);
    this.sentViews.forget(operatorId);
    this.#estop.latchers.gone(operatorId);
    return this.releaseLease(operatorId);
  }

  /** The message that tells this operator who drives. */
  leaseState(operatorId: string): LeaseState {
    const lease = this.#leases.leaseOf(operatorId);
    if (lease !== null) return { type: 'lease', holder: 'you', lease };
    return { type: 'lease', holder: this.#leases.holder === null ? 'nobody' : 'other' };
  }

  /**
   * Stops at once, whoever asks and however often. Then send every operator the `estopState`: its `latch` has changed.
   *
   * @param operatorId who asks, if it is an operator @returns false if it was already latched
   */
  latchEstop(by: EstopSource, operatorId?: string): boolean {
    this.#halt();
    return this.#estop.latch(by, operatorId);
  }

  /**
   * Only the lease holder or a supervisor can release it, within the policy (estop-release.ts). Motion then needs a new
   * command, from a hand that has let go (estop.ts).
   *
   * @param operatorId `null`: somebody at the robot, as if driving @param of the latch that is meant; else the present one
   */
  releaseEstop(operatorId: string | null, supervises = false, of?: number): EstopReleaseOutcome {
    const holdsLease = operatorId === null || this.#leases.holder === operatorId;
    return releaseEstop(this.#estop, this.#estopRelease, { operatorId, holdsLease, supervises, of });
  }

  /**
   * Stops at once, for a stop at the robot itself. Only {@link letGoEstop} with the same name takes that back. Then send
   * every operator the `estopState`. @returns false if it held the emergency stop already
   */
  holdEstop(stop: RobotStop): boolean {
    this.#halt();
    return this.#estop.hold(stop);
  }

  /** The stop at the robot was released; others may keep it latched. @returns false if it did not hold the emergency stop */
  letGoEstop(stop: RobotStop): boolean {
    return this.#estop.letGo(stop);
  }

  /** The stops at the robot that hold the emergency stop. */
  get estopHolders(): ReadonlySet<RobotStop> {
    return this.#estop.holders;
  }

  /** The message that tells every operator about the emergency stop. */
  estopState(): EstopState {
    return this.#estop.state;
  }

  /** What this operator must know of it in order to release it; `null` while it is not latched. */
  estopCause(operatorId: string): Omit<EstopCause, 'pressedBy' | 'start'> | null {
    return causeOf(this.#estop, this.#estopRelease, operatorId);
  }

  /**
   * Whose emergency stop must outlive a restart: an operator's comes before the robot's. `null` while it is released,
   * and while only {@link estopHolders} keep it.
   */
  get estopKeptFor(): EstopSource | null {
    if (this.#estop.ofOperator) return 'operator';
    return this.#estop.isAsked ? 'robot' : null;
  }

  #lookAtWheels(): string | null {
    const fault = this.#askWheels();
    if (fault !== null && this.#hadWheels) this.demandLetGo(WITHOUT_WHEELS);
    this.#hadWheels = fault === null;
    return fault;
  }

  #changeDriver(): void {
    this.#halt();
    this.view.forget();
    this.#estop.changeHand();
  }

  #halt(): void {
    if (!isZeroTwist(this.#wish)) this.#forced = true;
    this.#wish = zeroTwist();
    this.#watchdog.reset();
  }
}
