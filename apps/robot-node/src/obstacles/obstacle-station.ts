/** The main thread's obstacle guard: reads the capture threads' grids and odometry, and bounds the motion. */
import type { ObstacleGuardState, Twist } from '@farpoint/protocol';
import {
  Footprint,
  FREE,
  type Lookout,
  type MotionBound,
  type MotionGuard,
  ObstacleGuard,
} from '@farpoint/safety';
import type { Logger } from '@farpoint/service';
import type { TimedBaseState } from '../base/base.ts';
import type { Capture } from '../capture/capture.ts';
import type { GuardedSensors, ObstacleGuardConfiguration } from './guarded-sensors.ts';

export interface ObstacleStationOptions {
  configuration: ObstacleGuardConfiguration;
  grids: GuardedSensors['grids'];
  /** All of the robot's sensors. */
  captures: readonly Pick<Capture, 'guard'>[];
}

export class ObstacleStation implements MotionGuard, Lookout {
  readonly #options: ObstacleStationOptions;
  /** `null` if it is off. */
  readonly #guard: ObstacleGuard | null;
  #state: TimedBaseState | null = null;
  #driven = false;

  constructor(options: ObstacleStationOptions) {
    const { configuration, grids } = options;
    const { footprint, marginM, unseenMps, brakes } = configuration;
    this.#options = options;
    this.#guard =
      grids.length === 0
        ? null
        : new ObstacleGuard(new Footprint(footprint), grids.length, {
            ...{ marginM, unseenMps, emergency: brakes },
            // Before it must brake hard, it slows down more gently.
            braking: { linear: brakes.linear / 2, angular: (brakes.angular * 2) / 3 },
          });
  }

  state(nowMs: number): ObstacleGuardState {
    if (this.#guard === null) return 'off';
    this.#readGrids();
    return this.#guard.blind(nowMs) ? 'blind' : 'on';
  }

  /**
   * Called often, with the newest state of the base.
   *
   * @param driven whether somebody drives: only then are clouds judged, and captured for the guard alone
   */
  update(state: TimedBaseState | null, driven: boolean): void {
    if (this.#guard === null) return;
    if (state !== null && state !== this.#state) {
      this.#state = state;
      const { pose, twist, timeMs, measuredMs } = state;
      const { x, y, z, w } = pose.orientation;
      const yaw = Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
      this.#guard.moved({ x: pose.position.x, y: pose.position.y, yaw }, twist, measuredMs ?? timeMs);
    }
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
    return this.#guard.bound(wish, nowMs);
  }

  #readGrids(): void {
    this.#options.grids.forEach(({ reader }, index) => {
      const grid = reader.read();
      if (grid !== null) this.#guard?.see(index, grid);
    });
  }
}

/**
 * The obstacle guard as configured. Says in the log if it cannot work.
 *
 * @returns what bounds the motion; if it is off, it bounds nothing
 */
export function openObstacleGuard(options: ObstacleStationOptions, log: Logger): ObstacleStation {
  const { configuration, grids, captures } = options;
  if (configuration.mode === 'off') {
    log.warn({}, 'the obstacle guard is switched off: nothing on the robot looks where it goes');
  } else if (grids.length === 0) {
    log.warn(
      {},
      'the obstacle guard is off, because it is not known where the sensor sits on the robot: set guard.mount (--guard-mount)',
    );
  } else {
    log.info(
      { sensors: grids.length, unguarded: captures.length - grids.length },
      'the obstacle guard is on',
    );
  }
  return new ObstacleStation(options);
}
