import { shortestTurn } from '@farpoint/protocol';
import type { FloorPose } from '../obstacles/sensor-grid.ts';

/** Where the robot was on its way, in odometry's frame. */
export interface Crumb extends Readonly<FloorPose> {
  /** How far the robot had driven when it was there, m. */
  readonly drivenM: number;
}

export interface TrackOptions {
  /** What was longer ago than this way is forgotten, m. */
  maxM: number;
  /** No robot is faster: a pose that says so is a jump, m/s and rad/s. */
  mostMps: number;
  mostRadps: number;
}

/**
 * From one crumb to the next, at least one of these, m and rad. Chosen: a third of the way that it looks
 * ahead (track-follower.ts); track.test.ts holds these and the next two.
 */
const STEP_M = 0.1;
const STEP_RAD = 0.2;
/** Who comes so near to an earlier crumb, in its direction, is back there: what lies between is forgotten. */
const SAME_M = 0.08;
const SAME_RAD = 0.2;
/**
 * Odometry that says nothing for longer may have missed anything, ms. Chosen: at full speed a metre, more
 * than the 0.3 m that it may leave its track by.
 */
const SILENT_MS = 1000;
/**
 * What rounding and filters may add to a step between two poses. Chosen: half of a jump of odometry
 * (odometry.ts).
 */
const SLACK_M = 0.05;
const SLACK_RAD = 0.1;
/** Turns on the spot need no length. Chosen: twice as many crumbs as a straight way has bound the memory. */
const CRUMBS_PER_M = 20;

/**
 * The way on which the robot came, as crumbs from odometry, without the detours on which it came back to the same place. It
 * begins anew when the pose jumps or odometry was silent: what lies before has no place any more.
 */
export class Track {
  readonly #options: Readonly<TrackOptions>;
  #crumbs: Crumb[] = [];
  #pose: Readonly<FloorPose> | null = null;
  #atMs = Number.NEGATIVE_INFINITY;
  #drivenM = 0;

  constructor(options: TrackOptions) {
    this.#options = Object.freeze({ ...options });
  }

  /** The oldest first. The newest is not farther from the robot than a step. */
  get crumbs(): readonly Crumb[] {
    return this.#crumbs;
  }

  /** Where the robot was last; `null` before the first pose. */
  get pose(): Readonly<FloorPose> | null {
    return this.#pose;
  }

  /** When that was measured, ms. */
  get atMs(): number {
    return this.#atMs;
  }

  /** Way in all, m. */
  get drivenM(): number {
    return this.#drivenM;
  }

  /** From the newest crumb back to the oldest, m. */
  get lengthM(): number {
    return this.#crumbs.reduce((sum, crumb, i) => {
      const before = this.#crumbs[i - 1];
      return before === undefined ? 0 : sum + Math.hypot(crumb.x - before.x, crumb.y - before.y);
    }, 0);
  }

  /**
   * Takes a pose of odometry.
   *
   * @param measuredMs one that is not newer than the last changes nothing
   * @param lays whether the robot goes on: on its way back it lays no crumbs
   * @returns false if the track begins anew
   */
  note(pose: Readonly<FloorPose>, measuredMs: number, lays = true): boolean {
    const { x, y, yaw } = pose;
    if (![x, y, yaw, measuredMs].every(Number.isFinite) || measuredMs <= this.#atMs) return true;
    const before = this.#pose;
    const elapsedMs = measuredMs - this.#atMs;
    this.#pose = { x, y, yaw };
    this.#atMs = measuredMs;
    if (before === null || elapsedMs > SILENT_MS || this.#jumps(before, elapsedMs / 1000)) {
      this.forget();
      return before === null;
    }
    this.#drivenM += Math.hypot(x - before.x, y - before.y);
    const newest = this.#crumbs.at(-1);
    if (lays && (newest === undefined || isStep(newest, pose))) this.#lay(pose);
    return true;
  }

  /** The way back begins where the robot is. */
  begin(): void {
    if (this.#pose !== null) this.#crumbs.push({ ...this.#pose, drivenM: this.#drivenM });
  }

  /** The newest crumb lies behind a robot that goes back. */
  pass(): void {
    this.#crumbs.pop();
  }

  /** The track begins anew where the robot is. */
  forget(): void {
    this.#crumbs = this.#pose === null ? [] : [{ ...this.#pose, drivenM: this.#drivenM }];
  }

  #lay(pose: Readonly<FloorPose>): void {
    const again = this.#crumbs.findIndex((crumb) => isSame(crumb, pose));
    if (again >= 0) {
      this.#crumbs.length = again + 1;
      return;
    }
    this.#crumbs.push({ x: pose.x, y: pose.y, yaw: pose.yaw, drivenM: this.#drivenM });
    const { maxM } = this.#options;
    const kept = this.#crumbs.findIndex(({ drivenM }) => this.#drivenM - drivenM <= maxM);
    const most = Math.ceil(maxM * CRUMBS_PER_M) + 1;
    this.#crumbs.splice(0, Math.max(kept, this.#crumbs.length - most));
  }

  #jumps(before: Readonly<FloorPose>, seconds: number): boolean {
    const { x, y, yaw } = this.#pose as FloorPose;
    const { mostMps, mostRadps } = this.#options;
    if (Math.hypot(x - before.x, y - before.y) > mostMps * seconds + SLACK_M) return true;
    return Math.abs(shortestTurn(yaw - before.yaw)) > mostRadps * seconds + SLACK_RAD;
  }
}

function isStep(crumb: Readonly<FloorPose>, { x, y, yaw }: Readonly<FloorPose>): boolean {
  if (Math.hypot(x - crumb.x, y - crumb.y) >= STEP_M) return true;
  return Math.abs(shortestTurn(yaw - crumb.yaw)) >= STEP_RAD;
}

function isSame(crumb: Readonly<FloorPose>, { x, y, yaw }: Readonly<FloorPose>): boolean {
  if (Math.hypot(x - crumb.x, y - crumb.y) >= SAME_M) return false;
  return Math.abs(shortestTurn(yaw - crumb.yaw)) < SAME_RAD;
}
