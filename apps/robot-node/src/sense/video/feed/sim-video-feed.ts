import { officeWorld, SimulatedCamera, type WorldSnapshot, withThings } from '@farpoint/sim';
import { SharedWorld } from '../../base/shared-snapshot.ts';
import { type Feed, type FeedTarget, FrameRooms } from './feed.ts';
import type { SimVideoSource } from './feed-source.ts';
import { SimTrigger } from './sim-trigger.ts';

/** The simulated robot's video cameras, triggered together. */
export class SimVideoCameras {
  readonly #trigger = new SimTrigger(() => process.hrtime.bigint());
  #world: SharedWorld | null = null;
  #seen: WorldSnapshot | null = null;

  constructor() {
    this.#trigger.onRound = () => {
      this.#seen = this.#world?.newest ?? null;
    };
  }

  /** @throws {SimulationError} if the camera's options make no camera */
  async open(source: SimVideoSource, target: FeedTarget): Promise<Feed> {
    const { seed, things = [] } = source;
    const world = withThings(officeWorld(), things);
    const camera = await SimulatedCamera.create({ world, seed, camera: source.camera });
    this.#world ??= new SharedWorld(world, source.snapshot);
    const { width, height } = camera.intrinsics;
    const rooms = new FrameRooms();
    const end = this.#trigger.add({
      intervalNs: BigInt(Math.round(1e9 / source.framesPerS)),
      capture: (captureNs) => {
        // Where the process is behind, not even the rendering is worth its time.
        if (this.#seen === null || !target.takes) return;
        const { colour } = camera.render(this.#seen, { points: false });
        const bytes = rooms.room(colour.length);
        bytes.set(colour);
        target.pushFrame({ captureNs, format: 'rgba', width, height, stride: 4 * width, bytes });
        rooms.swap();
      },
    });
    return {
      close: () => {
        end();
        camera.close();
      },
    };
  }
}
