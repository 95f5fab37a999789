import { type CameraOptions, FLOOR_CAMERAS, officeWorld, SimulatedCamera, withThings } from '@farpoint/sim';
import { SharedWorld } from '../base/shared-snapshot.ts';
import type { ImageFrame, SourceDescription } from './frame-source.ts';
import type { SimSourceOptions } from './sim-source.ts';

/** Where the simulated robot's floor cameras look, in the order in which they are opened. */
export const SIM_FLOOR_CAMERAS: readonly { looks: string; place: CameraOptions }[] = [
  { looks: 'floor ahead', place: FLOOR_CAMERAS.ahead },
  { looks: 'floor behind', place: FLOOR_CAMERAS.behind },
];

/** One of the simulated robot's cameras for the floor at its wheels. Only its obstacle guard looks through them. */
export class SimFloorCamera {
  readonly description: SourceDescription;
  readonly #camera: SimulatedCamera;
  readonly #world: SharedWorld;

  private constructor(camera: SimulatedCamera, world: SharedWorld) {
    const { width, height, fx, fy, cx, cy } = camera.intrinsics;
    this.#camera = camera;
    this.#world = world;
    this.description = {
      ...{ kind: 'sim', width, height, capacity: width * height },
      ...{ camera: { fx, fy, cx, cy }, depthMeasure: 'z' },
    };
  }

  static async create(
    { seed, snapshot, things = [] }: SimSourceOptions,
    place: CameraOptions,
  ): Promise<SimFloorCamera> {
    const world = withThings(officeWorld(), things);
    const camera = await SimulatedCamera.create({ world, seed, camera: place });
    return new SimFloorCamera(camera, new SharedWorld(world, snapshot));
  }

  /** Looks now. The images are views that the next look overwrites. */
  capture(nowMs: number): ImageFrame {
    const { depth, colour, cameraPose } = this.#camera.render(this.#world.newest, { points: false });
    const words = new Uint32Array(colour.buffer, colour.byteOffset, depth.length);
    return { form: 'images', depth, colour: words, cameraPose, capturedAtMs: nowMs };
  }

  close(): void {
    this.#camera.close();
  }
}
