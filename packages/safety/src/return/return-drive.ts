import {
  isZeroTwist,
  type ReturnEnd,
  type ReturnState,
  shortestTurn,
  type ToldReturnPhase,
  type Twist,
  zeroTwist,
} from '@farpoint/protocol';
import type { UnattendedDrive, UnattendedFacts } from '../motion/unattended-drive.ts';
import type { FloorPose } from '../obstacles/sensor-grid.ts';
import { ODOMETRY_SILENT_MS, type ReturnOptions } from './return-options.ts';
import { Track, type TrackOptions } from './track.ts';
import { TrackFollower } from './track-follower.ts';

/** The robot's eyes, as far as a way back needs them. */
export interface Lookout {
  /** Whether every sensor and odometry give something now. */
  live(nowMs: number): boolean;
  /** Whether sensors see where the robot would go until it could stop. */
  sees(wish: Readonly<Twist>, nowMs: number): boolean;
}

export type ReturnPhase =
  | 'standby' // operators are heard, or nobody has driven since the last return
  | 'waiting' // nobody is heard any more
  | ToldReturnPhase;

/**
 * Operators who are silent for longer are lost, ms: as long as the page takes to call its path lost
 * (docs/return.md, docs/connection.md). return-drive.test.ts holds it.
 */
const LOST_MS = 1000;
/** A shorter track leads nowhere, m. Chosen: two crumbs (track.ts). */
const LEAST_TRACK_M = 0.2;
/**
 * A robot that moves less than this makes no progress, m and rad. Chosen: at 0.2 m/s it takes a quarter of a
 * second, while 20 s without it end the return.
 */
const PROGRESS_M = 0.05;
const PROGRESS_RAD = 0.1;
/**
 * If the waiting robot moves farther than this, something else moves it, m and rad. Chosen: above what
 * odometry drifts at rest; return-drive.test.ts holds it.
 */
const STRANGE_M = 0.1;
const STRANGE_RAD = 0.2;

/**
 * Drives the robot back along its track after it has lost all operators, once for each time that somebody has driven it.
 * Whatever ends it, it stands from then on. Times are the robot's monotonic clock in ms.
 *
 * These invariants hold for any sequence of calls:
 * - it asks for motion only after somebody has driven the robot since the last return, and only `afterMs` + `announceMs`
 *   or more after the last that was heard of any operator;
 * - it asks for nothing while anybody holds the lease, the emergency stop is latched, nothing takes the velocities, or
 *   odometry or a sensor is silent;
 * - it never asks for more than `maxLinear` and `maxAngular`, nor farther from the track than `toleranceM`;
 * - it asks for nothing after whoever drove has left on purpose, until somebody has driven again;
 * - once an operator is heard or the emergency stop is latched, it asks for nothing until somebody has driven again.
 */
export class ReturnDrive implements UnattendedDrive {
  /** Called at each change of the phase. */
  onPhase: ((phase: ReturnPhase, end: ReturnEnd | null) => void) | null = null;
  readonly #options: Readonly<ReturnOptions>;
  readonly #lookout: Lookout;
  readonly #track: Track;
  readonly #follower: TrackFollower;
  #phase: ReturnPhase = 'standby';
  #end: ReturnEnd | null = null;
  /** When the phase began. */
  #sinceMs = 0;
  /** When an operator was last heard. */
  #heardMs = Number.NEGATIVE_INFINITY;
  /** Whether somebody has driven since the last return, and nothing has stopped the robot since. */
  #armed = false;
  /** By the track's measure, when the return began, m. */
  #beganM = 0;
  #metres = 0;
  /** Where it was when it began to wait, or last got anywhere. */
  #mark: Readonly<FloorPose & { atMs: number }> | null = null;
  /** Why it does not ask for motion although it is on its way. */
  #held: ReturnEnd | null = null;

  constructor(options: ReturnOptions, track: Omit<TrackOptions, 'maxM'>, lookout: Lookout) {
    this.#options = Object.freeze({ ...options });
    this.#lookout = lookout;
    this.#track = new Track({ ...track, maxM: options.maxM });
    this.#follower = new TrackFollower(this.#track, options);
  }

  get phase(): ReturnPhase {
    return this.#phase;
  }

  /** Why the last return has ended; `null` before its end. */
  get end(): ReturnEnd | null {
    return this.#end;
  }

  /** Whether it is about to move the robot, or moves it: the sensors must look. */
  get isActive(): boolean {
    return this.#phase === 'announcing' || this.#phase === 'returning';
  }

  /** How far the last return has come, m. */
  get metres(): number {
    return this.#metres;
  }

  /** Length of the way back that is known, m. */
  get trackM(): number {
    return this.#track.lengthM;
  }

  /** What operators are told; undefined if there is nothing to say. */
  get told(): ReturnState | undefined {
    const phase = this.#phase;
    if (phase === 'standby' || phase === 'waiting') return undefined;
    return { phase, metres: this.#metres, ...(this.#end === null ? {} : { end: this.#end }) };
  }

  /** An operator's live session was heard. @param atMs what is not newer than what is known changes nothing */
  heard(atMs: number): void {
    if (!(atMs > this.#heardMs)) return;
    this.#heardMs = atMs;
    if (this.isActive) this.#finish('service-back', atMs);
    else if (this.#phase === 'waiting') this.#become('standby', atMs);
  }

  /**
   * Who drove last has left on purpose: it gave the lease back, its session was ended, or its permission. Only silence is a
   * reason to drive back.
   */
  left(nowMs: number): void {
    // A way back that has begun was begun by silence.
    if (this.isActive) return;
    this.#armed = false;
    if (this.#phase === 'waiting') this.#become('standby', nowMs);
  }

  /** Odometry came: the pose of base_link, and when it was measured. */
  moved(pose: Readonly<FloorPose>, measuredMs: number): void {
    const isReturning = this.#phase === 'returning';
    const isSame = this.#track.note(pose, measuredMs, !isReturning);
    if (!isReturning) return;
    this.#metres = this.#track.drivenM - this.#beganM;
    // The track has no place any more.
    if (!isSame) this.#finish('off-track', measuredMs);
  }

  wishAt(nowMs: number, facts: Readonly<UnattendedFacts>): Twist | null {
    if (facts.driven) {
      this.#heardMs = Math.max(this.#heardMs, nowMs);
      this.#armed = true;
      this.#end = null;
      this.#metres = 0;
      this.#become('standby', nowMs);
      return null;
    }
    // A reset must not start the machine: only somebody who drives arms it again.
    if (facts.latched) this.#armed = false;
    switch (this.#phase) {
      case 'standby':
        if (this.#armed && nowMs - this.#heardMs >= LOST_MS) {
          const { pose } = this.#track;
          this.#mark = pose === null ? null : { ...pose, atMs: nowMs };
          this.#become('waiting', nowMs);
        }
        return null;
      case 'waiting':
        this.#wait(nowMs, facts);
        return null;
      case 'announcing':
        this.#announce(nowMs, facts);
        return null;
      case 'returning':
        return this.#return(nowMs, facts);
      case 'ended':
        return null;
    }
  }

  #wait(nowMs: number, facts: Readonly<UnattendedFacts>): void {
    if (!this.#armed) this.#become('standby', nowMs);
    else if (this.#isBeyond(STRANGE_M, STRANGE_RAD)) this.#finish('moved', nowMs);
    else if (nowMs - this.#heardMs >= this.#options.afterMs && !facts.leased) {
      this.#metres = 0;
      const fault = this.#fault(nowMs, facts);
      if (fault !== null) this.#finish(fault, nowMs);
      else if (this.trackM < LEAST_TRACK_M) this.#finish('no-track', nowMs);
      else this.#become('announcing', nowMs);
    }
  }

  #announce(nowMs: number, facts: Readonly<UnattendedFacts>): void {
    const fault = this.#fault(nowMs, facts);
    if (fault !== null) this.#finish(fault, nowMs);
    else if (this.#isBeyond(STRANGE_M, STRANGE_RAD)) this.#finish('moved', nowMs);
    else if (nowMs - this.#sinceMs < this.#options.announceMs) return;
    else if (!this.#lookout.live(nowMs)) this.#finish('sensor-silent', nowMs);
    else {
      this.#track.begin();
      this.#beganM = this.#track.drivenM;
      this.#mark = null;
      this.#held = null;
      this.#become('returning', nowMs);
    }
  }

  #return(nowMs: number, facts: Readonly<UnattendedFacts>): Twist | null {
    const { pose } = this.#track;
    const fault = this.#fault(nowMs, facts);
    if (fault !== null || pose === null) return this.#finish(fault ?? 'odometry-silent', nowMs);
    if (nowMs - this.#sinceMs > this.#options.longestMs) return this.#finish('too-long', nowMs);
    if (this.#isStuck(pose, nowMs)) return this.#finish(this.#held ?? 'blocked', nowMs);
    const wish = this.#follower.step(pose);
    if (wish === 'arrived') return this.#finish('track-end', nowMs);
    if (wish === 'off-track') {
      this.#track.forget();
      return this.#finish('off-track', nowMs);
    }
    this.#held = this.#blindness(wish, nowMs);
    return this.#held === null ? wish : zeroTwist();
  }

  /** What ends a return at once, or keeps it from beginning. */
  #fault(nowMs: number, { latched, leased, wheels }: Readonly<UnattendedFacts>): ReturnEnd | null {
    if (latched) return 'estop';
    if (leased) return 'service-back';
    if (!wheels) return 'no-wheels';
    return nowMs - this.#track.atMs <= ODOMETRY_SILENT_MS ? null : 'odometry-silent';
  }

  #blindness(wish: Readonly<Twist>, nowMs: number): ReturnEnd | null {
    if (!this.#lookout.live(nowMs)) return 'sensor-silent';
    if (this.#options.unseen === 'slow' || isZeroTwist(wish)) return null;
    return this.#lookout.sees(wish, nowMs) ? null : 'unseen';
  }

  #isStuck(pose: Readonly<FloorPose>, nowMs: number): boolean {
    const mark = this.#mark;
    const gotOn = mark === null || this.#isBeyond(PROGRESS_M, PROGRESS_RAD);
    if (gotOn) this.#mark = { ...pose, atMs: nowMs };
    return !gotOn && nowMs - mark.atMs > this.#options.blockedMs;
  }

  /** Whether the robot is farther from its mark than this, m, or turned by more, rad. */
  #isBeyond(metres: number, turn: number): boolean {
    const [mark, { pose }] = [this.#mark, this.#track];
    if (mark === null || pose === null) return false;
    if (Math.hypot(pose.x - mark.x, pose.y - mark.y) >= metres) return true;
    return Math.abs(shortestTurn(pose.yaw - mark.yaw)) >= turn;
  }

  #finish(end: ReturnEnd, nowMs: number): null {
    this.#armed = false;
    this.#end = end;
    this.#become('ended', nowMs);
    return null;
  }

  #become(phase: ReturnPhase, nowMs: number): void {
    if (phase === this.#phase) return;
    this.#phase = phase;
    this.#sinceMs = nowMs;
    this.onPhase?.(phase, this.#end);
  }
}
