import type { Twist } from '@farpoint/protocol';
import { MOST_EXTRAPOLATION_MS } from './obstacle-guard-options.ts';
import type { FloorPose } from './sensor-grid.ts';

/**
 * How much further a turn moves what is around the robot than its outline, metres. Chosen: what may be met
 * within a second of a turn is hardly farther away.
 */
const AROUND_M = 1;
/**
 * How far back a cloud's capture may lie, in steps of commands. At 100 a second, 2.5 s: clouds that are older
 * are silent.
 */
const STEPS = 256;

/** Where the robot is: by odometry, or only how far it has gone by what it was told. */
export class Whereabouts {
  readonly #pose: FloorPose = { x: 0, y: 0, yaw: 0 };
  readonly #now: FloorPose = { x: 0, y: 0, yaw: 0 };
  #twist: Readonly<Twist> | null = null;
  #measuredMs = Number.NEGATIVE_INFINITY;
  /** The velocity that was last allowed, and since when. */
  #allowedMps = 0;
  #allowedMs: number | null = null;
  #travel = 0;
  /** Times and how far the robot had gone by then, in a ring. */
  readonly #times = new Float64Array(STEPS).fill(Number.POSITIVE_INFINITY);
  readonly #travels = new Float64Array(STEPS);
  #next = 0;

  /** Odometry came. @param twist `null` if nobody measures it */
  measured(pose: Readonly<FloorPose>, twist: Readonly<Twist> | null, measuredMs: number): void {
    if (![pose.x, pose.y, pose.yaw, measuredMs].every(Number.isFinite)) return;
    Object.assign(this.#pose, pose);
    this.#twist = twist;
    this.#measuredMs = measuredMs;
  }

  /** Nobody knows any more where the robot is. */
  lost(): void {
    this.#measuredMs = Number.NEGATIVE_INFINITY;
    this.#twist = null;
  }

  /** The velocity of base_link that odometry gave last; `null` without odometry. */
  get twist(): Readonly<Twist> | null {
    return this.#twist;
  }

  /** How old the newest odometry is, ms; infinite before the first. */
  ageMs(nowMs: number): number {
    return nowMs - this.#measuredMs;
  }

  silent(nowMs: number): boolean {
    return !(this.ageMs(nowMs) <= MOST_EXTRAPOLATION_MS);
  }

  /** The pose now: an object that the next call overwrites. @param placed without odometry, the origin */
  at(nowMs: number, placed: boolean): Readonly<FloorPose> {
    const now = this.#now;
    if (!placed) {
      [now.x, now.y, now.yaw] = [0, 0, 0];
      return now;
    }
    const { x, y, yaw } = this.#pose;
    const seconds = Math.min(Math.max(0, nowMs - this.#measuredMs), MOST_EXTRAPOLATION_MS) / 1000;
    const { linear, angular } = this.#twist ?? { linear: { x: 0, y: 0 }, angular: { z: 0 } };
    const heading = yaw + (angular.z * seconds) / 2;
    const [cos, sin] = [Math.cos(heading) * seconds, Math.sin(heading) * seconds];
    now.x = x + linear.x * cos - linear.y * sin;
    now.y = y + linear.x * sin + linear.y * cos;
    now.yaw = yaw + angular.z * seconds;
    return now;
  }

  /** What the robot was allowed to do from now on. */
  allowed(wish: Readonly<Twist>, factor: number, nowMs: number): void {
    this.#goTo(nowMs);
    const { linear, angular } = wish;
    this.#allowedMps = factor * (Math.hypot(linear.x, linear.y) + Math.abs(angular.z) * AROUND_M);
  }

  /** How far it has gone by now, by what it was allowed to do, metres. */
  travel(nowMs: number): number {
    this.#goTo(nowMs);
    return this.#travel;
  }

  /** How far it had gone at a time in the past; at an unknown one, at least as far back as it knows. */
  travelAt(timeMs: number): number {
    let least = Number.POSITIVE_INFINITY;
    let latest = Number.NEGATIVE_INFINITY;
    let known = 0;
    for (let i = 0; i < STEPS; i++) {
      const at = this.#times[i] as number;
      if (at === Number.POSITIVE_INFINITY) continue;
      least = Math.min(least, this.#travels[i] as number);
      if (at > timeMs || at < latest) continue;
      latest = at;
      known = this.#travels[i] as number;
    }
    return latest > Number.NEGATIVE_INFINITY ? known : Math.min(least, this.#travel);
  }

  #goTo(nowMs: number): void {
    if (this.#allowedMs !== null && nowMs <= this.#allowedMs) return;
    if (this.#allowedMs !== null) this.#travel += (this.#allowedMps * (nowMs - this.#allowedMs)) / 1000;
    this.#allowedMs = nowMs;
    this.#times[this.#next] = nowMs;
    this.#travels[this.#next] = this.#travel;
    this.#next = (this.#next + 1) % STEPS;
  }
}
