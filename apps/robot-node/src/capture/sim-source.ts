import type { Twist } from '@farpoint/protocol';
import { Simulation } from '@farpoint/sim';
import type { FrameSource, SourceDescription, SourceFrame, SourceState } from './frame-source.ts';

/** After a stall the simulated robot does not catch up with more than this, s. */
const MAX_STEP_S = 0.25;

export interface SimSourceOptions {
  seed: number;
  /** Pixels of the square camera, a multiple of 4. */
  size: number;
}

/** The simulated robot, in real time. */
export class SimSource implements FrameSource {
  readonly description: SourceDescription;
  readonly #simulation: Simulation;
  #lastMs: number | null = null;

  private constructor(simulation: Simulation) {
    const { width, height, fx, fy, cx, cy } = simulation.intrinsics;
    this.#simulation = simulation;
    this.description = {
      kind: 'sim',
      width,
      height,
      capacity: width * height,
      camera: { fx, fy, cx, cy },
      depthMeasure: 'z',
      drives: true,
    };
  }

  static async create({ seed, size }: SimSourceOptions): Promise<SimSource> {
    return new SimSource(await Simulation.create({ seed, camera: { width: size, height: size } }));
  }

  advance(nowMs: number, twist: Twist): void {
    const seconds = this.#lastMs === null ? 0 : (nowMs - this.#lastMs) / 1000;
    this.#lastMs = nowMs;
    this.#simulation.setCommand(twist);
    this.#simulation.step(Math.min(Math.max(seconds, 0), MAX_STEP_S));
  }

  capture(nowMs: number): SourceFrame {
    const { depth, colour, cameraPose } = this.#simulation.renderFrame({ points: false });
    const words = new Uint32Array(colour.buffer, colour.byteOffset, depth.length);
    return { form: 'images', depth, colour: words, cameraPose, captureMs: nowMs };
  }

  get state(): SourceState {
    const { pose, twist, battery, collision } = this.#simulation.state;
    const { voltage, percentage } = battery;
    return { pose, twist, battery: { voltage, percentage }, contact: collision };
  }

  close(): void {
    this.#simulation.close();
  }
}
