import {
  ageOfStampMs,
  type Command,
  type DriveLimits,
  type DriveState,
  type GoalHold,
  type GoalReason,
  type GoalRequest,
  isZeroTwist,
  type LeaseState,
  type Twist,
  zeroTwist,
} from '@farpoint/protocol';
import { CommandGate, type CommandVerdict, type RejectedCommand, WITHOUT_WHEELS } from './command-gate.ts';
import type { DriveGuardOptions } from './drive-guard-options.ts';
import { DriverWish } from './driver-wish.ts';
import type { GuidedDrive } from './guided/guided-drive.ts';
import { type LeaseOutcome, LeaseTable } from './lease.ts';
import { OperatorView } from './motion/operator-view.ts';
import { StoppableGuard } from './stoppable-guard.ts';

/** A goal that was in transit for longer is stale, ms. */
const STALE_GOAL_MS = 1000;

/**
 * Everything between the operators' messages and the robot's wheels. All times are the robot's monotonic clock in ms.
 *
 * These invariants hold for any sequence of calls:
 * - `velocityAt` stays within the limits given at construction, which nothing can change;
 * - it is zero `watchdogMs` after the last accepted command or hold of a goal, while the emergency stop is latched, and while nobody
 *   holds the lease;
 * - it follows the commands of the lease holder and of nobody else, or, while the lease holder holds on to a goal, the
 *   navigator that leads there;
 * - it is zero while nothing takes it ({@link DriveGuard.watchWheels});
 * - a request from before an emergency stop, a change of the lease, a fault of the wheels or a released grip never
 *   takes effect again;
 * - after the lease was handed over, it is zero until the new holder has shown an open grip while the robot stood.
 */
export class DriveGuard extends StoppableGuard {
  /** How old what the driver sees is. */
  readonly view = new OperatorView();
  readonly #limits: Readonly<DriveLimits>;
  readonly #gate: CommandGate;
  readonly #leases: LeaseTable;
  readonly #wish: DriverWish;
  #askWheels: () => string | null = () => null;
  #hadWheels = true;
  #askMotion: () => boolean = () => true;

  constructor(options: DriveGuardOptions) {
    super(options.limits.watchdogMs, options.estopRelease ?? 'driver');
    this.#limits = Object.freeze({ ...options.limits });
    this.#gate = new CommandGate(this.#limits, options);
    this.#leases = new LeaseTable(options);
    this.#wish = new DriverWish(this.#limits.watchdogMs, options.guided ?? null);
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
    const { verdict, holdsLease } = this.#judge(operatorId, command, nowMs);
    // An older command may have been sent before the goal was.
    const isFresh = verdict.accepted || verdict.reason !== 'repeated';
    if (holdsLease && isFresh && !isZeroTwist(command.twist)) this.#wish.takeOver();
    if (verdict.accepted) {
      this.#look(command.seenUs, nowMs);
      // What was read a while ago is valid for so much less.
      this.#wish.take(verdict.twist, nowMs - verdict.spentMs);
      if (!isZeroTwist(verdict.twist)) this.#leases.noteMotion(nowMs);
      return verdict;
    }
    // The gate gives this reason only for the holder's latest request: the grip was released, so stop now, not in 150
    // ms.
    if (verdict.reason === 'dead-man-released') this.#wish.halt('stick');
    return verdict;
  }

  /** @param sentMs the operator's clock @returns how much longer than usual the message was under way, ms */
  lateMs(operatorId: string, sentMs: number, nowMs: number): number {
    return this.#gate.observeClock(operatorId, sentMs, nowMs);
  }

  /** Drives to the driver's goals; `null` if the robot takes none. It is told by the guard what it must be told. */
  get guided(): GuidedDrive | null {
    return this.#wish.guided;
  }

  /**
   * Judges a goal. One that is taken leads the robot while its operator holds on to it.
   *
   * @returns why it is refused; `null` if it is taken
   */
  onGoal(operatorId: string, goal: GoalRequest, nowMs: number): GoalReason | null {
    const { id, x, y, yaw, lease, timeMs } = goal;
    const { guided } = this.#wish;
    if (guided === null) return 'off';
    if (!this.#leases.holds(operatorId, lease)) return 'not-lease-holder';
    if (!(this.#gate.observeClock(operatorId, timeMs, nowMs) <= STALE_GOAL_MS)) return 'stale';
    if (this.estop.latched) return 'estop';
    if (this.#lookAtWheels() !== null) return 'no-wheels';
    // Its hand may have been on the stick before the drive came to it.
    if (this.#gate.awaitsOpenGrip(operatorId)) return 'stick';
    return guided.begin({ operatorId, id, x, y, yaw }, nowMs);
  }

  /** The operator takes its goal back. Only its own: everybody else has STOP. */
  onGoalCancel(operatorId: string, id: number): void {
    const goal = this.#wish.guided?.goal;
    if (goal?.operatorId === operatorId && goal.id === id) this.#wish.halt('asked');
  }

  /** Judges the hold of a goal like a command that asks for no motion. */
  onGoalHold(operatorId: string, hold: GoalHold, nowMs: number): CommandVerdict {
    const { sequence, timeMs, lease, goal, seenUs } = hold;
    const command: Command = {
      ...{ type: 'command', sequence, timeMs, lease, deadMan: true, twist: zeroTwist() },
    };
    const { verdict } = this.#judge(operatorId, command, nowMs);
    if (!verdict.accepted) return verdict;
    this.#look(seenUs, nowMs);
    if (this.#wish.hold(operatorId, goal, nowMs - verdict.spentMs)) this.#leases.noteMotion(nowMs);
    return verdict;
  }

  /** A message that should have been a command but could not be decoded. It counts against the operator's rate. */
  onMalformed(operatorId: string, detail: string, nowMs: number): RejectedCommand {
    return this.#gate.malformed(operatorId, detail, nowMs);
  }

  /**
   * Optional, for each clock probe of an operator: teaches the gate the transit time on this path, so that it can tell
   * stale from fresh at the very first command.
   */
  onClockProbe(operatorId: string, sentMs: number, nowMs: number): void {
    this.#gate.observeClock(operatorId, sentMs, nowMs);
  }

  /** A picture or cloud was taken that will be sent to the operator. */
  onViewSupplied(operatorId: string, nowMs: number): void {
    if (this.#leases.holder === operatorId) this.view.supplied(nowMs);
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
    this.#askMotion = stands;
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
    this.#wish.halt(why === WITHOUT_WHEELS ? 'no-wheels' : 'view');
    this.#gate.requireLetGo(why);
  }

  /** The velocity that the driver asks for now, within the limits, as a copy. */
  velocityAt(nowMs: number): Twist {
    this.#lookAtWheels();
    const wish = this.#wish.at(nowMs);
    return this.#leases.holder !== null && !this.estop.latched ? wish : zeroTwist();
  }

  /** Whether something other than the driver's wish makes `velocityAt` zero: brake as hard as allowed. */
  stopsUrgently(nowMs: number): boolean {
    return this.estop.latched || this.#wish.stopsUrgently(nowMs);
  }

  /** Whether the driver must let go once before the robot moves again. */
  get awaitsLetGo(): boolean {
    const { holder } = this.#leases;
    return holder !== null && this.#gate.awaitsLetGo(holder);
  }

  /** When `velocityAt` becomes zero without any further call: arm a timer for it. `null` while the velocity is zero. */
  get nextDeadlineMs(): number | null {
    return this.#wish.deadlineMs;
  }

  /** @param blocked whether the robot senses an obstacle */
  state(nowMs: number, blocked = false): DriveState {
    if (this.estop.latched) return 'estop';
    if (this.#leases.holder === null || !this.#wish.isMoving) return 'idle';
    if (this.#wish.isOverdue(nowMs)) return 'watchdog';
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
    if (this.#leases.holder !== before) this.#changeDriver();
    return outcome;
  }

  /**
   * The driver hands the lease to another operator. The robot brakes at once, and stands until the new driver has shown an
   * open grip after that: a hand that is on the stick already moves nothing. Then send every operator its `leaseState`.
   *
   * @returns false if `from` does not drive; then nothing has changed
   */
  handOver(from: string, to: string, nowMs: number): boolean {
    if (!this.#leases.handOver(from, to, nowMs)) return false;
    this.#gate.requireOpenGrip(to);
    this.#changeDriver();
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
    this.estop.withdraw(operatorId);
    return this.releaseLease(operatorId);
  }

  /** The message that tells this operator who drives. */
  leaseState(operatorId: string): LeaseState {
    const lease = this.#leases.leaseOf(operatorId);
    if (lease !== null) return { type: 'lease', holder: 'you', lease };
    return { type: 'lease', holder: this.#leases.holder === null ? 'nobody' : 'other' };
  }

  #lookAtWheels(): string | null {
    const fault = this.#askWheels();
    if (fault !== null && this.#hadWheels) this.demandLetGo(WITHOUT_WHEELS);
    this.#hadWheels = fault === null;
    return fault;
  }

  #judge(
    operatorId: string,
    command: Command,
    nowMs: number,
  ): { verdict: CommandVerdict; holdsLease: boolean } {
    const wheelsFault = this.#lookAtWheels();
    const holdsLease = this.#leases.holds(operatorId, command.lease);
    const meetEstop = (motion: boolean) => this.estop.meet(motion, nowMs);
    const context = { holdsLease, meetEstop, wheelsFault, stands: this.#askMotion() };
    const verdict = this.#gate.check(operatorId, command, nowMs, context);
    return { verdict, holdsLease };
  }

  #look(seenUs: number | undefined, nowMs: number): void {
    this.view.note(seenUs === undefined ? null : ageOfStampMs(seenUs, nowMs), nowMs);
  }

  protected override stopAtOnce(): void {
    this.#wish.halt('estop');
  }

  #changeDriver(): void {
    this.#wish.halt('lease-lost');
    this.view.forget();
  }
}
