import type { Intervention, NearSector, Twist } from '@farpoint/protocol';
import { FREE, type MotionBound, type MotionGuard } from '../motion/motion-guard.ts';
import { FloorMap } from './floor-map.ts';
import type { Footprint } from './footprint.ts';
import { type FreeWay, FreeWaySearch, type Sweep } from './free-way.ts';
import { NearFieldSearch } from './near-field-search.ts';
import {
  CREEPING_MPS,
  CREEPING_SHARE,
  defaultObstacleGuardOptions,
  GO_ABOVE_MPS,
  type ObstacleGuardOptions,
  RELEASE_SHARE,
  STOP_BELOW_MPS,
} from './obstacle-guard-options.ts';
import type { FloorPose, SensorGrid } from './sensor-grid.ts';
import { Whereabouts } from './whereabouts.ts';

const [WIDE, NARROW] = [0, 1];
/**
 * Without odometry, a cell no longer counts as free when the robot has gone this far since it was seen,
 * metres. Chosen: two cells, below the margin; obstacle-guard.test.ts holds it.
 */
const FREE_MEMORY_M = 0.1;

/** Bounds the robot's motion by what its sensors' whole clouds say about the floor on its way. */
export class ObstacleGuard implements MotionGuard {
  readonly #options: ObstacleGuardOptions;
  readonly #map: FloorMap;
  readonly #search: FreeWaySearch;
  readonly #nearField: NearFieldSearch;
  readonly #reach: number;
  readonly #whereabouts = new Whereabouts();
  /** When each sensor's newest cloud was taken, ms. */
  readonly #lastMs: number[];
  /** Of which sensors nobody knows where they sit. */
  readonly #disputed: boolean[];
  /** What was placed by poses before is somewhere else, ms. */
  #jumpedMs = Number.NEGATIVE_INFINITY;
  /** The direction in which the robot has been stopped; `null` if it has not. */
  #stopped: string | null = null;
  #braking = false;
  /** The share of the wish that was last allowed. */
  #lastSpeed = 0;

  /** @param sensors how many there are; each must give clouds, or all motion is slow */
  constructor(footprint: Footprint, sensors: number, options: Partial<ObstacleGuardOptions> = {}) {
    this.#options = { ...defaultObstacleGuardOptions, ...options };
    const { marginM } = this.#options;
    this.#map = new FloorMap({ ...this.#options, freeMemoryM: FREE_MEMORY_M });
    const narrow = marginM * CREEPING_SHARE;
    this.#search = new FreeWaySearch(this.#map, footprint, [
      marginM,
      narrow,
      // Where something is already nearer.
      (2 * narrow) / 3,
      narrow / 3,
    ]);
    this.#nearField = new NearFieldSearch(this.#map, footprint);
    this.#reach = footprint.reach;
    this.#lastMs = new Array<number>(sensors).fill(Number.NEGATIVE_INFINITY);
    this.#disputed = new Array<boolean>(sensors).fill(false);
  }

  /** Takes what a sensor's newest cloud says. @param sensor its number, from 0 */
  see(sensor: number, grid: SensorGrid): void {
    if (!(grid.capturedAtMs > (this.#lastMs[sensor] ?? Number.POSITIVE_INFINITY))) return;
    const firstPlane = this.#lastMs.length - this.#options.planes;
    const plane = sensor < firstPlane ? null : sensor - firstPlane;
    if (grid.placed && grid.capturedAtMs < this.#jumpedMs) return;
    // Grids in two frames cannot be one map. The clouds' frame counts; a scanner in another is silent.
    if (plane !== null && grid.placed !== this.#map.placed && this.#cloudsLive(grid.capturedAtMs)) return;
    this.#lastMs[sensor] = grid.capturedAtMs;
    this.#disputed[sensor] = grid.disputed === true;
    if (grid.disputed === true) return;
    const half = grid.side / 2;
    this.#map.centreOn(grid.firstX + half, grid.firstY + half);
    this.#map.merge(grid, grid.placed ? 0 : this.#whereabouts.travelAt(grid.capturedAtMs), plane);
  }

  /** Takes odometry: the pose of base_link, its velocity if it is known, and when they were measured. */
  moved(pose: Readonly<FloorPose>, twist: Readonly<Twist> | null, measuredMs: number): void {
    this.#whereabouts.measured(pose, twist, measuredMs);
  }

  /** Odometry is not believed any more: it counts as silent until the next {@link moved}. */
  lost(): void {
    this.#whereabouts.lost();
  }

  /**
   * The pose has jumped: what was placed by poses before is somewhere else. The sensors count as silent until they give
   * something newer.
   *
   * @param atMs since when the pose is another
   */
  jumped(atMs: number): void {
    this.#jumpedMs = atMs;
    if (!this.#map.placed) return;
    this.#map.forget();
    this.#lastMs.fill(Number.NEGATIVE_INFINITY);
  }

  /** How old each sensor's newest cloud is, and whether the sensor counts as silent; ms, infinite before the first. */
  sensors(nowMs: number): { ageMs: number; silent: boolean }[] {
    return this.#lastMs.map((lastMs) => ({
      ageMs: nowMs - lastMs,
      silent: this.#isSilent(lastMs, nowMs),
    }));
  }

  /** How old odometry is; infinite before the first, ms. */
  odometryAgeMs(nowMs: number): number {
    return this.#whereabouts.ageMs(nowMs);
  }

  /** Whether no sensor at all gives clouds. */
  blind(nowMs: number): boolean {
    return this.#lastMs.every((lastMs) => this.#isSilent(lastMs, nowMs));
  }

  /** Whether every sensor gives clouds, and odometry a pose. */
  live(nowMs: number): boolean {
    return this.#map.placed && !this.#someSilent(nowMs, true);
  }

  /** Whether the floor is known on the arc of a wish, as far as the robot goes before it stands. Changes nothing. */
  sees(wish: Readonly<Twist>, nowMs: number): boolean {
    const placed = this.#map.placed;
    const { reactionMs, braking, timeToCollisionMs } = this.#options;
    const horizonS = Math.max(reactionMs + 500 * slowingS(wish, braking), timeToCollisionMs) / 1000;
    const pose = this.#whereabouts.at(nowMs, placed);
    const travel = placed ? 0 : this.#whereabouts.travel(nowMs);
    return this.#search.look({ pose, wish, horizonS, nowMs, travel }, NARROW).unknownS >= horizonS;
  }

  /** What is around the robot now; `null` while nobody can tell. Changes nothing. */
  nearField(nowMs: number): NearSector[] | null {
    const placed = this.#map.placed;
    if (this.blind(nowMs) || (placed && this.#whereabouts.silent(nowMs))) return null;
    const travel = placed ? 0 : this.#whereabouts.travel(nowMs);
    return this.#nearField.look(this.#whereabouts.at(nowMs, placed), nowMs, travel);
  }

  bound(wish: Readonly<Twist>, nowMs: number): Readonly<MotionBound> {
    const bound = this.#bound(wish, nowMs);
    this.#whereabouts.allowed(wish, bound.factor, nowMs);
    this.#lastSpeed = bound.factor * this.#search.speedOf(wish);
    return bound;
  }

  #bound(wish: Readonly<Twist>, nowMs: number): Readonly<MotionBound> {
    const speed = this.#search.speedOf(wish);
    if (speed === 0) {
      this.#stopped = null;
      this.#braking = false;
      return FREE;
    }
    if (!Number.isFinite(speed)) return stopFor('obstacle');
    if (this.#disputed.includes(true)) return stopFor('sensor-silent');
    const placed = this.#map.placed;
    const { reactionMs, braking, emergency, timeToCollisionMs } = this.#options;
    const reactionS = reactionMs / 1000;
    const comfort = { reactionS, slowS: slowingS(wish, braking) };
    const sweep: Sweep = {
      pose: this.#whereabouts.at(nowMs, placed),
      wish,
      horizonS: Math.max(reactionS + comfort.slowS / 2, timeToCollisionMs / 1000),
      nowMs,
      travel: placed ? 0 : this.#whereabouts.travel(nowMs),
    };
    const wide = { ...this.#search.look(sweep, WIDE) };
    // Where the wide outline meets nothing, the narrow one does not either.
    const met = wide.contactS < Number.POSITIVE_INFINITY;
    const narrow = met ? { ...this.#search.look(sweep, NARROW) } : wide;
    const deeper = this.#search.deeper(sweep, NARROW, WIDE);
    if (deeper !== null) [narrow.contactS, narrow.cause] = [0, deeper];

    const hard = { reactionS, slowS: slowingS(wish, emergency) };
    if (this.#mustBrake(narrow, speed, hard)) return stopFor(interventionOf(narrow));

    // Nor is a robot that creeps let nearer to an edge.
    const isEdge = wide.cause === 'drop-off';
    const creeping = isEdge ? 0 : CREEPING_MPS / speed;
    const near = Math.min(
      this.#shareBefore(narrow.contactS, comfort),
      Math.max(this.#shareBefore(wide.contactS, comfort), creeping),
    );
    const direction = directionOf(wish);
    const least = this.#stopped === direction ? GO_ABOVE_MPS : STOP_BELOW_MPS;
    // A wish that is itself slower than that need not become faster.
    if (near < 1 && near * speed < Math.min(least, speed)) {
      this.#stopped = direction;
      return stopFor(isEdge ? 'drop-off' : interventionOf(narrow));
    }
    this.#stopped = null;

    const capped = this.#options.unseenMps / this.#pace(wish);
    const unknownS = Math.min(narrow.unknownS, wide.unknownS);
    const unseen = Math.max(this.#shareBefore(unknownS, comfort), capped);
    const silent = this.#someSilent(nowMs, placed) ? capped : 1;
    const factor = Math.min(near, unseen, silent);
    if (factor >= 1) return FREE;
    const reason = factor === near ? 'obstacle-near' : factor === silent ? 'sensor-silent' : 'unseen-space';
    return { factor, reason, urgent: false };
  }

  /** The share of the wish with which the robot stops before what it meets in `contactS` of the whole wish. */
  #shareBefore(contactS: number, { reactionS, slowS }: Stopping): number {
    if (contactS === Number.POSITIVE_INFINITY) return 1;
    const stopping =
      slowS > 0
        ? (Math.sqrt(reactionS * reactionS + 2 * slowS * contactS) - reactionS) / slowS
        : contactS / reactionS;
    return Math.min(1, stopping, contactS / (this.#options.timeToCollisionMs / 1000));
  }

  /** Whether the robot, as fast as it is, can only just stop, or not even that. */
  #mustBrake({ contactS }: FreeWay, speed: number, { reactionS, slowS }: Stopping): boolean {
    const { twist } = this.#whereabouts;
    const now = (twist === null ? this.#lastSpeed : this.#search.speedOf(twist)) / speed;
    const stopS = now * reactionS + (now * now * slowS) / 2;
    const way = this.#braking ? contactS * RELEASE_SHARE : contactS;
    this.#braking = stopS > way && now * speed > STOP_BELOW_MPS;
    return this.#braking;
  }

  /** Speed of a motion as people reckon it: forwards, or of the outline while turning, m/s. */
  #pace({ linear, angular }: Readonly<Twist>): number {
    return Math.max(Math.hypot(linear.x, linear.y), Math.abs(angular.z) * this.#reach);
  }

  #someSilent(nowMs: number, placed: boolean): boolean {
    const isNeeded = placed || this.#options.odometry;
    if (isNeeded && (!placed || this.#whereabouts.silent(nowMs))) return true;
    return this.#lastMs.some((lastMs) => this.#isSilent(lastMs, nowMs));
  }

  #cloudsLive(nowMs: number): boolean {
    const clouds = this.#lastMs.length - this.#options.planes;
    return this.#lastMs.some((lastMs, sensor) => sensor < clouds && !this.#isSilent(lastMs, nowMs));
  }

  #isSilent(lastMs: number, nowMs: number): boolean {
    return !(nowMs - lastMs <= this.#options.silentAfterMs);
  }
}

interface Stopping {
  /** Before the brakes act, s. */
  reactionS: number;
  /** From the whole wish to standing, s. */
  slowS: number;
}

function slowingS({ linear, angular }: Readonly<Twist>, brakes: { linear: number; angular: number }): number {
  return Math.max(Math.hypot(linear.x, linear.y) / brakes.linear, Math.abs(angular.z) / brakes.angular);
}

function stopFor(reason: Intervention): MotionBound {
  return { factor: 0, reason, urgent: true };
}

function interventionOf({ cause }: FreeWay): Intervention {
  return cause ?? 'obstacle';
}

/** Forwards, backwards, sideways, and which way round: another direction is another decision. */
function directionOf({ linear, angular }: Readonly<Twist>): string {
  // A stick is never quite straight.
  return [linear.x, linear.y, angular.z].map((part) => Math.sign(Math.round(part * 10))).join();
}
