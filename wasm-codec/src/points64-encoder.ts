/** Encodes a frame of points to the data blocks of its packets. */
import { Encoder } from '../pkg/farpoint_codec.js';
import type { Codec } from './codec.ts';
import { CodecError, type CodecErrorCode } from './errors.ts';
import type { Pinhole } from './organised-encoder.ts';
import {
  checkCapacity,
  checkSlotLayout,
  DEFAULT_SLOT_LAYOUT,
  packetsFor,
  type SlotLayout,
} from './slot-layout.ts';

/** The paper's sampling (equations 4 and 5) of a camera's images; the defaults are the paper's. */
export interface ImageSamplingParameters {
  /** How many points to choose (the paper's N_max, see `maxPoints`); all sendable points if there are fewer. */
  count: number;
  /** The same frame, parameters and seed give the same choice. 0 to 2⁶⁴ − 1. */
  seed: number | bigint;
  /** λ ≥ 0: how fast the weight falls with depth; 0 is uniform. Up to 64; default 3. */
  lambda?: number;
  /** ε: keeps the weight of the nearest points finite. 1e-12 to 1; default 1e-6. */
  epsilon?: number;
  /** D: points nearer than this weigh as much as the nearest, metres; default 3.85. */
  nearDistance?: number;
  /** Points with a coordinate beyond ±32.767 m: left out (default), or kept and saturated. */
  outOfRange?: 'reject' | 'saturate';
}

/** The same for a frame of points. */
export interface SamplingParameters extends ImageSamplingParameters {
  /** How many points of the frame are filled, from its beginning. */
  points: number;
  /** `z` (default): the z coordinate, a camera. `range`: the distance from the sensor, a LiDAR. */
  depthMeasure?: 'z' | 'range';
}

/** Why points of a frame are not sent; each counts once, under the first reason that applies. */
export interface RejectedPoints {
  /** A coordinate is NaN or infinite. */
  notFinite: number;
  /** The depth is zero (below a micrometre) or negative. */
  nonPositiveDepth: number;
  /** A coordinate is beyond ±32.767 m. */
  outOfRange: number;
  /** It could be sent, but was not drawn. */
  notDrawn: number;
}

export interface SampleReport {
  /** Points chosen. Together with all of `rejected`, they add up to the frame's points. */
  kept: number;
  rejected: RejectedPoints;
  /** Smallest and largest depth of the points that could be sent, metres; 0 if there were none. */
  minDepth: number;
  maxDepth: number;
}

export interface PackOptions {
  /**
   * `raster` (default): as in the frame. `near-first`: by bands of depth whose far edge doubles (1, 2, 4, 8, 16 m), in
   * raster order within a band.
   */
  order?: 'raster' | 'near-first';
  /** Makes every colour the latency test's green (0x03F0). Default false. */
  latencyTest?: boolean;
}

export interface PackReport {
  /** Slots used; all but the last hold 150 points. */
  packets: number;
  points: number;
  /** Points with a coordinate that was cut to ±32.767 m. */
  saturated: number;
}

/** Result codes of the module's `sample`. */
const FAULTS: readonly (readonly [CodecErrorCode, string])[] = [
  ['bad-parameter', 'lambda is not between 0 and 64'],
  ['bad-parameter', 'epsilon is not between 1e-12 and 1'],
  ['bad-parameter', 'nearDistance is negative or not finite'],
  ['too-many-points', 'more points than the capacity'],
  ['no-stream', 'no camera was set'],
];
const MAX_SEED = 2n ** 64n - 1n;

/**
 * Samples frames and packs them. Its buffers are in the module's memory and are created once: fill {@link frame}, call
 * {@link sample} and {@link pack}, send from {@link packets}. For a depth camera, call {@link setCamera} once, fill
 * {@link depth} and {@link colour}, and call {@link sampleImages}: this takes a third of the bytes, and gives the same
 * packets as the images' points.
 *
 * The views are recreated when the module's memory has grown (because another encoder or decoder was created): take
 * them from the encoder for each frame and do not keep them.
 */
export class Points64Encoder implements Disposable {
  readonly capacityPoints: number;
  readonly layout: Readonly<SlotLayout>;
  readonly #memory: Codec['memory'];
  readonly #encoder: Encoder;
  #buffer: ArrayBuffer | undefined;
  #pixels = 0;
  #depth = new Float32Array(0);
  #colour = new Uint32Array(0);
  #packets = new Uint8Array(0);
  #report = new Float64Array(0);
  #kept = 0;

  /** @throws CodecError `bad-capacity`, `bad-layout` */
  constructor(codec: Codec, capacityPoints: number, layout: SlotLayout = DEFAULT_SLOT_LAYOUT) {
    checkCapacity('capacityPoints', capacityPoints);
    checkSlotLayout(layout);
    const encoder = Encoder.create(capacityPoints, layout.stride, layout.dataOffset);
    if (encoder === undefined) throw new CodecError('bad-layout', 'a block does not fit into its slot');
    this.capacityPoints = capacityPoints;
    this.layout = { ...layout };
    this.#memory = codec.memory;
    this.#encoder = encoder;
  }

  /**
   * 4 floats per point: x, y, z in metres in the sensor's optical frame, and the colour's bytes R, G, B, A as the bits
   * of the fourth. Write the colours through {@link frameBits}: JavaScript may change the bits of a NaN.
   */
  get frame(): Float32Array {
    const pointer = this.#encoder.frame_ptr();
    return new Float32Array(this.#memory.buffer, pointer, this.capacityPoints * 4);
  }

  /** The same memory as {@link frame}, as 32-bit words. */
  get frameBits(): Uint32Array {
    const pointer = this.#encoder.frame_ptr();
    return new Uint32Array(this.#memory.buffer, pointer, this.capacityPoints * 4);
  }

  /**
   * Sets the camera of {@link depth} and {@link colour}, which are created now.
   *
   * @throws CodecError `bad-parameter` for values that no camera has, or more pixels than the capacity
   */
  setCamera({ width, height, fx, fy, cx, cy }: { width: number; height: number } & Pinhole): void {
    const whole = Number.isInteger(width) && Number.isInteger(height) && width > 0 && height > 0;
    if (!whole || !this.#encoder.set_camera(width, height, fx, fy, cx, cy)) {
      throw new CodecError('bad-parameter', `no camera of at most ${this.capacityPoints} pixels`);
    }
    this.#pixels = width * height;
    this.#buffer = undefined;
  }

  /** Depth along z, metres, one float per pixel, row by row; invalid: NaN, infinite, zero or negative. */
  get depth(): Float32Array {
    this.#refresh();
    return this.#depth;
  }

  /** R, G, B, A of each pixel, R lowest. */
  get colour(): Uint32Array {
    this.#refresh();
    return this.#colour;
  }

  /** The packet slots, one after another, laid out according to {@link layout}. */
  get packets(): Uint8Array {
    this.#refresh();
    return this.#packets;
  }

  /** The points that the last sampling chose: indices into its frame, ascending. */
  get chosen(): Uint32Array {
    return new Uint32Array(this.#memory.buffer, this.#encoder.chosen_ptr(), this.#kept);
  }

  /**
   * Draws `count` points of the frame without replacement, with probability exactly proportional to their weight.
   *
   * @throws CodecError `bad-count`, `too-many-points`, `bad-parameter`
   */
  sample(parameters: SamplingParameters): SampleReport {
    checkCount('points', parameters.points);
    return this.#sample(false, parameters);
  }

  /**
   * The same for the images.
   *
   * @throws CodecError `bad-count`, `bad-parameter`, `no-stream` without a camera
   */
  sampleImages(parameters: ImageSamplingParameters): SampleReport {
    return this.#sample(true, { ...parameters, points: this.#pixels });
  }

  #sample(images: boolean, parameters: SamplingParameters): SampleReport {
    const { points, count, seed } = parameters;
    checkCount('count', count);
    this.#kept = 0;
    const fault = this.#encoder.sample(
      images,
      points,
      Math.min(count, points),
      parameters.lambda ?? 3,
      parameters.epsilon ?? 1e-6,
      parameters.nearDistance ?? 3.85,
      parameters.depthMeasure === 'range',
      parameters.outOfRange === 'saturate',
      toSeed(seed),
    );
    if (fault !== 0) {
      const [code, message] = FAULTS[fault - 1] ?? (['bad-parameter', 'a parameter was refused'] as const);
      throw new CodecError(code, code === 'too-many-points' ? `${points} points: ${message}` : message);
    }
    this.#refresh();
    const report = this.#report;
    this.#kept = report[0] as number;
    return {
      kept: this.#kept,
      rejected: {
        notFinite: report[1] as number,
        nonPositiveDepth: report[2] as number,
        outOfRange: report[3] as number,
        notDrawn: report[4] as number,
      },
      minDepth: report[5] as number,
      maxDepth: report[6] as number,
    };
  }

  /** Writes the chosen points as `points64` data blocks into the slots. */
  pack(options: PackOptions = {}): PackReport {
    this.#encoder.pack(options.order === 'near-first', options.latencyTest ?? false);
    this.#refresh();
    const report = this.#report;
    return {
      packets: report[7] as number,
      points: report[8] as number,
      saturated: report[9] as number,
    };
  }

  /** Frees the memory; the encoder and its views must not be used afterwards. */
  [Symbol.dispose](): void {
    this.#encoder.free();
  }

  #refresh(): void {
    const { buffer } = this.#memory;
    if (buffer === this.#buffer) return;
    this.#buffer = buffer;
    const encoder = this.#encoder;
    this.#depth = new Float32Array(buffer, encoder.depth_ptr(), this.#pixels);
    this.#colour = new Uint32Array(buffer, encoder.colour_ptr(), this.#pixels);
    const bytes = packetsFor(this.capacityPoints) * this.layout.stride;
    this.#packets = new Uint8Array(buffer, encoder.slots_ptr(), bytes);
    this.#report = new Float64Array(buffer, encoder.report_ptr(), 10);
  }
}

function checkCount(name: string, count: number): void {
  if (!Number.isInteger(count) || count < 0 || count > 0x7fff_ffff) {
    throw new CodecError('bad-count', `${name} is ${count}, not a whole number from 0 on`);
  }
}

function toSeed(seed: number | bigint): bigint {
  const whole = typeof seed === 'bigint' || Number.isSafeInteger(seed);
  if (!whole || seed < 0 || seed > MAX_SEED) {
    throw new CodecError('bad-parameter', `seed is ${seed}, not a whole number from 0 to 2^64 - 1`);
  }
  return BigInt(seed);
}
