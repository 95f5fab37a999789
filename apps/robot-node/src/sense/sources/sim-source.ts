import type { FrameSource, ImageFrame, SourceDescription } from '@farpoint/cloud-source';
import { type CameraOptions, officeWorld, SimulatedCamera, type Thing, withThings } from '@farpoint/sim';
import { SharedWorld } from '../base/shared-snapshot.ts';
import { STANDING } from './playback-source.ts';

export interface SimSourceOptions {
  seed: number;
  /** Side of the square image in pixels, a multiple of 4. */
  size: number;
  /** Whether the robot has cameras for the floor at its wheels, through which its obstacle guard looks. */
  floorCameras?: boolean | undefined;
  /** The base's thread writes the world here. If undefined, the robot stays at its start and nothing moves. */
  snapshot?: SharedArrayBuffer | undefined;
  /** Put into the world. */
  things?: readonly Thing[] | undefined;
  /** It captures at the multiples of this rate's interval, with cameras of this rate; if undefined, when it is asked. */
  triggerPerS?: number | undefined;
}

/** A depth camera of the simulated robot. Renders the world from the base's state. */
export class SimSource implements FrameSource {
  readonly description: SourceDescription;
  readonly state = STANDING;
  readonly #camera: SimulatedCamera;
  readonly #world: SharedWorld;

  private constructor(camera: SimulatedCamera, world: SharedWorld) {
    const { width, height, fx, fy, cx, cy } = camera.intrinsics;
    this.#camera = camera;
    this.#world = world;
    this.description = {
      kind: 'sim',
      width,
      height,
      capacity: width * height,
      camera: { fx, fy, cx, cy },
      depthMeasure: 'z',
    };
  }

  /** @param place where the camera sits and what it sees; by default, the robot's main camera */
  static async create(
    { seed, size, snapshot, things = [] }: SimSourceOptions,
    place: CameraOptions = { width: size, height: size },
  ): Promise<SimSource> {
    const world = withThings(officeWorld(), things);
    const camera = await SimulatedCamera.create({ world, seed, camera: place });
    return new SimSource(camera, new SharedWorld(world, snapshot));
  }

  /** The images are views that the next capture overwrites. */
  capture(nowMs: number): ImageFrame {
    const { depth, colour, cameraPose } = this.#camera.render(this.#world.newest, { points: false });
    const words = new Uint32Array(colour.buffer, colour.byteOffset, depth.length);
    return { form: 'images', depth, colour: words, cameraPose, capturedAtMs: nowMs };
  }

  close(): void {
    this.#camera.close();
  }
}
