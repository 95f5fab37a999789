/** All of a sensor's thread that judges for the obstacle guard: its clouds, and cameras that are there for nothing else. */

import type { SourceDescription, SourceFrame } from '@farpoint/cloud-source';
import type { CameraOptions } from '@farpoint/sim';
import { EvenPace } from '@farpoint/timing';
import type { Codec } from '@farpoint/wasm-codec';
import type { SourceOptions } from '../sources/open-source.ts';
import { SimSource } from '../sources/sim-source.ts';
import { CloudGuard, type CloudGuardOptions } from './cloud-guard.ts';

/** How often each floor camera looks, ms: what they see is remembered for seconds, and they count as silent after 400 ms. */
const FLOOR_EVERY_MS = 100;
/**
 * The same while nobody drives. As often as clouds are judged then
 * (docs/decisions/2026-11-28-cost-of-a-frame.md).
 */
const IDLE_FLOOR_EVERY_MS = 200;

export interface SensorGuardOptions {
  clouds: CloudGuardOptions;
  /** The simulated robot's cameras for the floor at its wheels; empty if there are none. */
  floor: readonly FloorCameraOptions[];
}

/** A camera through which only the guard looks. */
export interface FloorCameraOptions {
  place: CameraOptions;
  guard: CloudGuardOptions;
}

interface FloorGuard {
  camera: SimSource;
  guard: CloudGuard;
}

export class SensorGuard implements Disposable {
  readonly #clouds: CloudGuard;
  readonly #floor: readonly FloorGuard[];
  readonly #pace = new EvenPace();
  /** The floor camera whose turn it is. */
  #next = 0;

  private constructor(clouds: CloudGuard, floor: readonly FloorGuard[]) {
    this.#clouds = clouds;
    this.#floor = floor;
  }

  static async open(
    codec: Codec,
    source: SourceOptions,
    description: SourceDescription,
    { clouds, floor }: SensorGuardOptions,
  ): Promise<SensorGuard> {
    const opened: FloorGuard[] = [];
    if (source.kind === 'sim') {
      for (const { place, guard } of floor) {
        const camera = await SimSource.create(source, place);
        opened.push({ camera, guard: new CloudGuard(codec, camera.description, guard) });
      }
    }
    return new SensorGuard(new CloudGuard(codec, description, clouds), opened);
  }

  /** Judges a cloud. */
  take(frame: SourceFrame): void {
    this.#clouds.take(frame);
  }

  /**
   * Looks through one of the floor cameras, in turn, if it is time. Call it as often as clouds are judged, when no cloud
   * waits: all at once would keep the next one waiting longer.
   *
   * @param guarding whether somebody drives
   */
  lookDown(nowMs: number, guarding: boolean): void {
    const next = this.#floor[this.#next];
    if (next === undefined) return;
    const everyMs = (guarding ? FLOOR_EVERY_MS : IDLE_FLOOR_EVERY_MS) / this.#floor.length;
    if (!this.#pace.takes(nowMs, everyMs)) return;
    this.#pace.taken(nowMs, everyMs);
    this.#next = (this.#next + 1) % this.#floor.length;
    next.guard.take(next.camera.capture(nowMs));
  }

  [Symbol.dispose](): void {
    this.#clouds[Symbol.dispose]();
    for (const { camera, guard } of this.#floor) {
      guard[Symbol.dispose]();
      camera.close();
    }
  }
}
