/** All of a sensor's thread that judges for the obstacle guard: its clouds, and cameras that are there for nothing else. */
import { EvenPace } from '@farpoint/timing';
import type { Codec } from '@farpoint/wasm-codec';
import type { SourceDescription, SourceFrame } from '../capture/frame-source.ts';
import type { SourceOptions } from '../capture/open-source.ts';
import { SIM_FLOOR_CAMERAS, SimFloorCamera } from '../capture/sim-floor-camera.ts';
import { CloudGuard, type CloudGuardOptions } from './cloud-guard.ts';

/** How often floor cameras look, ms: what they see is remembered for seconds, and they count as silent after 400 ms. */
const FLOOR_EVERY_MS = 100;

export interface SensorGuardOptions {
  clouds: CloudGuardOptions;
  /** Of each floor camera, in the order of {@link SIM_FLOOR_CAMERAS}; empty if there are none. */
  floor: readonly CloudGuardOptions[];
}

interface FloorGuard {
  camera: SimFloorCamera;
  guard: CloudGuard;
}

export class SensorGuard implements Disposable {
  readonly #clouds: CloudGuard;
  readonly #floor: readonly FloorGuard[];
  readonly #pace = new EvenPace();

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
      for (const [i, options] of floor.entries()) {
        const camera = await SimFloorCamera.create(source, SIM_FLOOR_CAMERAS[i]?.place ?? {});
        opened.push({ camera, guard: new CloudGuard(codec, camera.description, options) });
      }
    }
    return new SensorGuard(new CloudGuard(codec, description, clouds), opened);
  }

  /** Judges a cloud. */
  take(frame: SourceFrame): void {
    this.#clouds.take(frame);
  }

  /** Looks through the floor cameras, if it is time. Call it as often as clouds are judged, when no cloud waits. */
  lookDown(nowMs: number): void {
    if (this.#floor.length === 0 || !this.#pace.takes(nowMs, FLOOR_EVERY_MS)) return;
    this.#pace.taken(nowMs, FLOOR_EVERY_MS);
    for (const { camera, guard } of this.#floor) guard.take(camera.capture(nowMs));
  }

  [Symbol.dispose](): void {
    this.#clouds[Symbol.dispose]();
    for (const { camera, guard } of this.#floor) {
      guard[Symbol.dispose]();
      camera.close();
    }
  }
}
