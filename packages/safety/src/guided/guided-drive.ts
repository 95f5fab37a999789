import {
  type GoalPhase,
  type GoalReason,
  type Intervention,
  isZeroTwist,
  sequenceDelta32,
  type Twist,
  zeroTwist,
} from '@farpoint/protocol';
import type { FloorPose } from '../obstacles/sensor-grid.ts';
import { turnBetween } from '../return/turn.ts';
import type { GuidedOptions } from './guided-options.ts';

/** A place in odometry's frame, and who named it. */
export interface Goal {
  operatorId: string;
  /** Counts up with each goal of this operator; wraps at 2³². */
  id: number;
  /** m. */
  x: number;
  y: number;
  /** The direction in which the robot is to stand, rad; undefined for any. */
  yaw?: number | undefined;
}

/** Where the robot is, and since when that is known. */
interface KnownPose {
  pose: Readonly<FloorPose>;
  atMs: number;
}

/** Odometry that is older than so many times the watchdog's time is silent. */
const ODOMETRY_SILENCES = 2;
/** Less is no progress, m and rad. */
const PROGRESS_M = 0.05;
const PROGRESS_RAD = 0.1;
/** Odometry may say that the robot is by so much faster than it is allowed to be, and by so much elsewhere at once, m. */
const FASTER = 1.5;
const JUMP_M = 0.3;
/** At its goal, a navigator that has said nothing for so long has done, ms. */
const DONE_MS = 1000;

/**
 * Drives to a goal by a navigator's velocities for as long as its operator holds on to it. It decides nothing about who
 * may: the drive guard asks it, and bounds it. Times are the robot's monotonic clock in ms.
 *
 * These invariants hold for any sequence of calls:
 * - it asks for motion only between the first hold of the present goal and `watchdogMs` after the newest one;
 * - a goal that has ended, whyever, never moves the robot again;
 * - it asks for nothing while the navigator's newest velocity is older than `navigatorSilentMs`, or was said before the
 *   goal was;
 * - it never asks for more than `maxLinear` and `maxAngular`.
 */
export class GuidedDrive {
  /** Called at each change of what becomes of a goal. */
  onState: ((goal: Readonly<Goal>, state: GoalPhase, reason: GoalReason | null) => void) | null = null;
  /** Why a goal cannot be taken although it is near enough; `null`: it can. */
  judge: ((goal: Readonly<Goal>, nowMs: number) => GoalReason | null) | null = null;
  readonly #options: Readonly<GuidedOptions>;
  #goal: Readonly<Goal> | null = null;
  /** The newest goal of the operator who named one last, whether or not it was taken. */
  #newest: { operatorId: string; id: number } | null = null;
  #isDriving = false;
  #begunMs = 0;
  #heldMs: number | null = null;
  #said: { twist: Twist; atMs: number } | null = null;
  #known: KnownPose | null = null;
  /** Where it was when it last got anywhere. */
  #mark: KnownPose | null = null;

  constructor(options: GuidedOptions) {
    this.#options = Object.freeze({ ...options });
  }

  get options(): Readonly<GuidedOptions> {
    return this.#options;
  }

  /** Where it is to go; `null` if nowhere. */
  get goal(): Readonly<Goal> | null {
    return this.#goal;
  }

  /** Where the robot is; `null` before the first odometry. */
  get pose(): Readonly<FloorPose> | null {
    return this.#known?.pose ?? null;
  }

  /** When it asks for something else without any further call; `null` if it asks for nothing. */
  get deadlineMs(): number | null {
    if (this.#goal === null || this.#heldMs === null || this.#said === null) return null;
    return Math.min(
      this.#heldMs + this.#options.watchdogMs,
      this.#said.atMs + this.#options.navigatorSilentMs,
    );
  }

  /**
   * A goal, from somebody who may name one. It replaces the present one, which ends even if this one is refused.
   *
   * @returns why it is refused; `null` if it is taken
   */
  begin(goal: Goal, nowMs: number): GoalReason | null {
    const { operatorId, id, x, y } = goal;
    const before = this.#newest;
    if (before?.operatorId === operatorId && sequenceDelta32(id, before.id) <= 0) return 'repeated';
    this.#newest = { operatorId, id };
    this.end('cancelled', 'replaced');
    const known = this.#known;
    if (known === null || !this.#isKnown(nowMs)) return 'no-pose';
    // Written so that NaN is too far.
    if (!(Math.hypot(x - known.pose.x, y - known.pose.y) <= this.#options.mostM)) return 'too-far';
    const refusal = this.judge?.(goal, nowMs) ?? null;
    if (refusal !== null) return refusal;
    this.#goal = Object.freeze({ ...goal });
    [this.#begunMs, this.#heldMs, this.#said, this.#isDriving] = [nowMs, null, null, false];
    this.#mark = { pose: known.pose, atMs: nowMs };
    this.onState?.(this.#goal, 'accepted', null);
    return null;
  }

  /**
   * The operator holds on to a goal.
   *
   * @param atMs since when that is known
   * @returns whether it is the present one
   */
  hold(operatorId: string, id: number, atMs: number): boolean {
    if (this.#goal?.operatorId !== operatorId || this.#goal.id !== id) return false;
    // A hold that comes after the watchdog's time revives nothing.
    if (this.#endsBy(atMs)) return false;
    this.#heldMs = Math.max(this.#heldMs ?? Number.NEGATIVE_INFINITY, atMs);
    return true;
  }

  /**
   * A velocity of the navigator. What is not finite, or on an axis that the robot does not have, counts as zero; what is
   * too fast is slowed down along its arc.
   *
   * @param atMs when it came
   * @returns false if it cannot be followed
   */
  navigate({ linear, angular }: Readonly<Twist>, atMs: number): boolean {
    const { maxLinear, maxAngular } = this.#options;
    const other = [linear.y, linear.z, angular.x, angular.y];
    const isValid = Number.isFinite(linear.x + angular.z) && other.every((value) => value === 0);
    const twist = zeroTwist();
    if (isValid) {
      const excess = Math.max(1, Math.abs(linear.x) / maxLinear, Math.abs(angular.z) / maxAngular);
      // Never beyond, however the division rounds; never −0.
      twist.linear.x = within(maxLinear, linear.x / excess);
      twist.angular.z = within(maxAngular, angular.z / excess);
    }
    if (this.#goal !== null && atMs >= (this.#said?.atMs ?? this.#begunMs)) this.#said = { twist, atMs };
    return isValid;
  }

  /** Odometry came: the pose of base_link, and when it was measured. */
  moved(pose: Readonly<FloorPose>, measuredMs: number): void {
    const before = this.#known;
    if (before !== null && !(measuredMs > before.atMs)) return;
    this.#known = { pose: { ...pose }, atMs: measuredMs };
    if (before === null || this.#goal === null) return;
    const most = (this.#options.maxLinear * FASTER * (measuredMs - before.atMs)) / 1000 + JUMP_M;
    const way = Math.hypot(pose.x - before.pose.x, pose.y - before.pose.y);
    if (!(way <= most)) this.end('cancelled', 'pose-jump');
  }

  /** What it asks for now, as a copy; `null` if there is no goal. */
  velocityAt(nowMs: number): Twist | null {
    if (this.#goal === null || this.#endsBy(nowMs)) return null;
    if (this.#heldMs === null) return zeroTwist();
    const said = this.#said;
    const isFresh = said !== null && nowMs - said.atMs < this.#options.navigatorSilentMs;
    const asked = isFresh ? said.twist : null;
    if (this.#isThere(asked, nowMs)) {
      this.end('reached', null);
      return null;
    }
    if (nowMs - (said?.atMs ?? this.#begunMs) >= this.#options.navigatorLostMs) {
      this.end('cancelled', 'navigator-silent');
      return null;
    }
    if (this.#isStuck(nowMs)) {
      this.end('blocked', 'no-progress');
      return null;
    }
    if (asked === null || isZeroTwist(asked)) return zeroTwist();
    if (!this.#isDriving) {
      this.#isDriving = true;
      this.onState?.(this.#goal, 'driving', null);
    }
    return { linear: { ...asked.linear }, angular: { ...asked.angular } };
  }

  /** Something holds the robot where it stands: it does not go on by itself. */
  blocked(by: Intervention): void {
    this.end('blocked', reasonOf(by));
  }

  /** @returns whether there was a goal */
  end(state: GoalPhase, reason: GoalReason | null): boolean {
    const goal = this.#goal;
    if (goal === null) return false;
    [this.#goal, this.#heldMs, this.#said] = [null, null, null];
    this.onState?.(goal, state, reason);
    return true;
  }

  /** Ends it if the operator is silent, or nobody knows where the robot is. */
  #endsBy(nowMs: number): boolean {
    const { firstHoldMs, watchdogMs } = this.#options;
    const held = this.#heldMs;
    // Written so that NaN ends it.
    const isHeld = held === null ? nowMs - this.#begunMs < firstHoldMs : nowMs - held < watchdogMs;
    if (!isHeld) return this.end('cancelled', 'silence');
    return !this.#isKnown(nowMs) && this.end('cancelled', 'no-pose');
  }

  /** Whether odometry says where the robot is: it may be silent for longer than an operator, but not for long. */
  #isKnown(nowMs: number): boolean {
    const silentMs = ODOMETRY_SILENCES * this.#options.watchdogMs;
    return this.#known !== null && nowMs - this.#known.atMs <= silentMs;
  }

  /** Whether it is near its goal, and its navigator has done. @param asked by the navigator now */
  #isThere(asked: Readonly<Twist> | null, nowMs: number): boolean {
    const [goal, known] = [this.#goal, this.#known];
    if (goal === null || known === null) return false;
    if (Math.hypot(goal.x - known.pose.x, goal.y - known.pose.y) > this.#options.reachedM) return false;
    return asked === null ? nowMs - (this.#said?.atMs ?? this.#begunMs) >= DONE_MS : isZeroTwist(asked);
  }

  #isStuck(nowMs: number): boolean {
    const [mark, known] = [this.#mark, this.#known];
    if (mark === null || known === null) return false;
    const way = Math.hypot(known.pose.x - mark.pose.x, known.pose.y - mark.pose.y);
    const turn = Math.abs(turnBetween(mark.pose.yaw, known.pose.yaw));
    if (way >= PROGRESS_M || turn >= PROGRESS_RAD) {
      this.#mark = { pose: known.pose, atMs: nowMs };
      return false;
    }
    return nowMs - mark.atMs >= this.#options.stuckMs;
  }
}

/** −most … most; never −0. */
function within(most: number, value: number): number {
  return Math.min(Math.max(value, -most), most) + 0;
}

function reasonOf(by: Intervention): GoalReason {
  switch (by) {
    case 'fence':
    case 'fence-near':
      return 'fence';
    case 'view-unknown':
    case 'view-late':
    case 'view-lost':
    case 'blind-travel':
      return 'view';
    default:
      return 'obstacle';
  }
}
