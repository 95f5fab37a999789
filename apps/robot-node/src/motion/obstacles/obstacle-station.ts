/** The main thread's obstacle guard: reads the sensors' grids and odometry, and bounds the motion. */
import {
  type Intervention,
  type NearField,
  nearFieldText,
  type ObstacleGuardState,
  type Twist,
} from '@farpoint/protocol';
import {
  Footprint,
  FREE,
  type Lookout,
  type MeasuredMotion,
  type MotionBound,
  type MotionGuard,
  ObstacleGuard,
} from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import type { BaseOdometry } from '../../sense/base/base-odometry.ts';
import type { Capture } from '../../sense/capture/capture.ts';
import type { SharedGridReader } from '../../sense/obstacles/shared-grid.ts';
import type { GuardReport } from './guard-report.ts';
import { GuardTopics } from './guard-topics.ts';
import { GRID_SHAPE, type GuardedGrid, type ObstacleGuardConfiguration } from './guarded-sensors.ts';

export interface ObstacleStationOptions {
  configuration: ObstacleGuardConfiguration;
  /** Empty if the guard is off. */
  grids: readonly GuardedGrid[];
  /** Whether something is to say where the robot is; default: nothing. */
  odometry?: boolean;
  /** All of the robot's sensors. */
  captures: readonly Pick<Capture, 'guard'>[];
  /** Their names. */
  names?: readonly string[];
  /** The topics of a ROS graph that bound the motion as well; `null` if there are none. */
  topics?: GuardTopics | null;
}

export class ObstacleStation implements MotionGuard, Lookout {
  readonly topics: GuardTopics | null;
  /** All that bounds the motion by what is around the robot. */
  readonly guards: readonly MotionGuard[];
  readonly #options: ObstacleStationOptions;
  /** `null` if it is off. */
  readonly #guard: ObstacleGuard | null;
  #moved: MeasuredMotion | null = null;
  #jumps = 0;
  #driven = false;
  #reason: Intervention | null = null;

  constructor(options: ObstacleStationOptions) {
    const { configuration, grids, topics = null, odometry = false } = options;
    const { footprint, marginM, unseenMps, brakes, scansShowFloor = false } = configuration;
    this.#options = options;
    this.topics = topics;
    this.guards = topics?.collision == null ? [this] : [this, topics.collision];
    const planes = topics?.topics.length ?? 0;
    const sensors = grids.length + planes;
    this.#guard =
      sensors === 0
        ? null
        : new ObstacleGuard(new Footprint(footprint), sensors, {
            marginM,
            unseenMps,
            emergency: brakes,
            planes,
            planesShowFloor: scansShowFloor,
            odometry,
            // Before it must brake hard, it slows down more gently.
            braking: { linear: brakes.linear / 2, angular: (brakes.angular * 2) / 3 },
          });
  }

  state(nowMs: number): ObstacleGuardState {
    if (this.#guard === null) return 'off';
    this.#readGrids();
    return this.#guard.blind(nowMs) ? 'blind' : 'on';
  }

  /** Whether somebody drives. */
  get driven(): boolean {
    return this.#driven;
  }

  /** What is around the robot, for operators; `null` while nobody can tell. */
  nearField(nowMs: number): NearField | null {
    if (this.#guard === null) return null;
    this.#readGrids();
    const sectors = this.#guard.nearField(nowMs);
    return sectors === null
      ? null
      : { type: 'nearField', timeMs: Math.round(nowMs), sectors: nearFieldText(sectors) };
  }

  /** What it knows now, for those who look after the robot. */
  report(nowMs: number): GuardReport {
    const { grids, names = [] } = this.#options;
    this.#readGrids();
    const seen = this.#guard?.sensors(nowMs) ?? [];
    const nameOf = ({ sensor, looks }: GuardedGrid) =>
      [names[sensor] ?? `sensor ${sensor}`, ...(looks === undefined ? [] : [looks])].join(', ');
    const called = [...grids.map(nameOf), ...this.#scans];
    return {
      state: this.state(nowMs),
      driven: this.#driven,
      sensors: this.#readers.map(({ count }, i) => {
        const { ageMs, silent } = seen[i] ?? { ageMs: Number.POSITIVE_INFINITY, silent: true };
        // Clouds are judged while somebody drives, scans always.
        const isExpected = this.#driven || i >= grids.length;
        return { name: called[i] ?? '', ageMs, silent, isExpected, ...count };
      }),
      odometryAgeMs: this.#guard?.odometryAgeMs(nowMs) ?? Number.POSITIVE_INFINITY,
      reason: this.#reason,
      collision: this.topics?.collisionState(nowMs) ?? null,
      restarts: this.topics?.restarts ?? 0,
    };
  }

  /**
   * Called often, with where the robot is.
   *
   * @param driven whether somebody drives: only then is every cloud judged, and are clouds captured for the guard alone
   */
  update({ newest, jumps }: Pick<BaseOdometry, 'jumps' | 'newest'>, driven: boolean): void {
    if (this.#guard === null) return;
    if (jumps.count !== this.#jumps) this.#guard.jumped(jumps.lastMs);
    this.#jumps = jumps.count;
    if (newest === null && this.#moved !== null) this.#guard.lost();
    if (newest !== null && newest !== this.#moved) {
      const { pose, twist, measuredMs } = newest;
      this.#guard.moved(pose, twist, measuredMs);
      this.topics?.moved(pose, twist, measuredMs);
    }
    this.#moved = newest;
    if (driven === this.#driven) return;
    this.#driven = driven;
    for (const { sensor } of this.#options.grids) this.#options.captures[sensor]?.guard(driven);
  }

  live(nowMs: number): boolean {
    this.#readGrids();
    return this.#guard?.live(nowMs) === true;
  }

  sees(wish: Readonly<Twist>, nowMs: number): boolean {
    return this.#guard?.sees(wish, nowMs) === true;
  }

  bound(wish: Readonly<Twist>, nowMs: number): Readonly<MotionBound> {
    if (this.#guard === null) return FREE;
    this.#readGrids();
    const bound = this.#guard.bound(wish, nowMs);
    this.#reason = bound.reason;
    return bound;
  }

  async close(): Promise<void> {
    await this.topics?.close();
  }

  get #scans(): readonly string[] {
    return this.topics?.topics ?? [];
  }

  get #readers(): readonly SharedGridReader[] {
    return [...this.#options.grids.map(({ reader }) => reader), ...(this.topics?.readers ?? [])];
  }

  #readGrids(): void {
    const { grids } = this.#options;
    for (let i = 0; i < grids.length; i++) this.#see(i, grids[i]?.reader);
    const scans = this.topics?.readers ?? [];
    for (let i = 0; i < scans.length; i++) this.#see(grids.length + i, scans[i]);
  }

  #see(sensor: number, reader: SharedGridReader | undefined): void {
    const grid = reader?.read() ?? null;
    if (grid !== null) this.#guard?.see(sensor, grid);
  }
}

/**
 * The obstacle guard as configured. Says in the log if it cannot work.
 *
 * @param odometry whether it is known where the robot is
 * @returns what bounds the motion; if it is off, only what another program demands does
 */
export function openObstacleGuard(
  options: Omit<ObstacleStationOptions, 'topics'>,
  odometry: boolean,
  log: Logger,
): ObstacleStation {
  const { configuration, grids, captures } = options;
  const { mode, clearanceM, heightM, footprint } = configuration;
  const isOff = mode === 'off';
  const guarded = new Set(grids.map(({ sensor }) => sensor)).size;
  const scans = isOff ? [] : (configuration.topics?.scans ?? []);
  const collision = configuration.topics?.collision ?? null;
  if (isOff) {
    log.warn({}, 'the obstacle guard is switched off: nothing on the robot looks where it goes');
  } else if (grids.length + scans.length === 0) {
    log.warn(
      {},
      'the obstacle guard is off, because it is not known where the sensor sits on the robot: set guard.mount (--guard-mount)',
    );
  } else {
    log.info(
      { sensors: guarded, scans: scans.length, unguarded: captures.length - guarded },
      'the obstacle guard is on',
    );
  }
  const reachM = Math.max(...footprint.map(({ x, y }) => Math.hypot(x, y)));
  const plan = { shape: GRID_SHAPE, odometry, clearanceM, heightM, reachM };
  const { graph } = configuration.topics ?? {};
  const hears = graph !== undefined && (scans.length > 0 || collision !== null);
  const topics = hears ? new GuardTopics({ ...plan, graph, scans, collision }, log) : null;
  return new ObstacleStation({ ...options, topics });
}
