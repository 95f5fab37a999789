import {
  CloudGuard,
  GRID_SHAPE,
  makeSharedGrid,
  opticalMount,
  SharedGridReader,
} from '@farpoint/robot-node/testing/guard-parts';
import { DEFAULT_CAMERA, type SimulatedBase, SimulatedCamera, type WorldDescription } from '@farpoint/sim';
import { loadCodecFromDisk } from '@farpoint/wasm-codec/node';

/** Pixels each way: fewer than the robot's own camera has. */
const SIZE = 96;
const INTERVAL_MS = 50;
/** From a cloud's capture until the guard has it, ms. */
const DELAY_MS = 30;
const BAND = { clearanceM: 0.04, heightM: 1.1, dropM: 0.15 };
const NO_COLOUR = new Uint32Array();

/** The obstacle guard's sight: the simulated depth camera of the robot, and the grid that is made of its clouds. */
export class GuardSight implements Disposable {
  readonly reader: SharedGridReader;
  readonly #camera: SimulatedCamera;
  readonly #clouds: CloudGuard;
  #nextMs = Number.NEGATIVE_INFINITY;
  #lens = true;

  private constructor(camera: SimulatedCamera, clouds: CloudGuard, reader: SharedGridReader) {
    [this.#camera, this.#clouds, this.reader] = [camera, clouds, reader];
  }

  /** @param turned by how much the camera looks to the left of where it usually does, rad */
  static async open(world: WorldDescription, seed = 1, turned = 0): Promise<GuardSight> {
    const codec = await loadCodecFromDisk();
    const looks = { yaw: DEFAULT_CAMERA.yaw + turned };
    const camera = await SimulatedCamera.create({
      world,
      seed,
      camera: { width: SIZE, height: SIZE, ...looks },
    });
    const { fx, fy, cx, cy } = camera.intrinsics;
    const { forward: x, left: y, up: z, pitch, yaw } = { ...DEFAULT_CAMERA, ...looks };
    const memory = makeSharedGrid(GRID_SHAPE);
    const description = { kind: 'sim', width: SIZE, height: SIZE, capacity: SIZE * SIZE } as const;
    const clouds = new CloudGuard(
      codec,
      { ...description, depthMeasure: 'z', camera: { fx, fy, cx, cy } },
      {
        ...{ memory, shape: GRID_SHAPE, odometry: true, ...BAND, blankIsMissing: true },
        mount: opticalMount({ x, y, z, roll: 0, pitch, yaw }),
      },
    );
    return new GuardSight(camera, clouds, new SharedGridReader(memory, GRID_SHAPE));
  }

  /** Whether the camera gives clouds. */
  set sees(sees: boolean) {
    this.#lens = sees;
  }

  /** Called every 10 ms. @param nowMs robot's clock */
  look(base: SimulatedBase, nowMs: number): void {
    if (!this.#lens || nowMs < this.#nextMs) return;
    this.#nextMs = nowMs + INTERVAL_MS;
    const { depth, cameraPose } = this.#camera.render(base.snapshot, { points: false });
    setTimeout(() => {
      this.#clouds.take({ form: 'images', depth, colour: NO_COLOUR, cameraPose, capturedAtMs: nowMs });
    }, DELAY_MS);
  }

  [Symbol.dispose](): void {
    this.#clouds[Symbol.dispose]();
    this.#camera.close();
  }
}
