import { OrganisedEncoder as Binding } from '../pkg/farpoint_codec.js';
import type { Codec } from './codec.ts';
import { CodecError } from './errors.ts';
import { BUDGET_COLOURS, COARSE_COLOUR, COLOUR_MODES, type OrganisedColour } from './organised-colour.ts';
import { checkSlotLayout, DEFAULT_SLOT_LAYOUT, type SlotLayout } from './slot-layout.ts';

/** A pinhole camera: pixel (u, v) sees along ((u − cx) / fx, (v − cy) / fy, 1). Pixels. */
export interface Pinhole {
  fx: number;
  fy: number;
  cx: number;
  cy: number;
}

/** Why a frame is not accepted as a depth camera's image. Such a frame is coded as unorganised. */
export type Misfit =
  | 'shape' // a single row or column
  | 'too-few-points' // no valid points, or all in one row or column
  | 'no-focal-length' // the points give a focal length that no camera has
  | 'off-grid'; // a point does not lie on its pixel's ray

export type GridResult =
  | { fits: true; camera: Pinhole }
  /** `pixels`: how far the worst point is from its ray, for `off-grid`. */
  | { fits: false; reason: Misfit; pixels?: number };

/** The paper's validity (equations 4 and 5): which tiles are thinned first. */
export interface Thinning {
  /** Fraction of the nearest pixels to keep, 0 to 1; above 1, the farther ones keep more. Ignored with a budget. */
  density?: number;
  /** λ, default 3. */
  lambda?: number;
  /** ε, default 1e-6. */
  epsilon?: number;
  /** D, metres, default 3.85. */
  nearDistance?: number;
}

export interface OrganisedOptions {
  /** Bytes of all packets: depth level, colour and thinning are chosen to use them up. */
  budgetBytes?: number;
  /** Without a budget: 0 to 7, the depth error is at most 0.0625 · 2^level mm · z². Default 3 (0.5 mm · z²). */
  depthLevel?: number;
  /** Without a budget: default quality 18. With a budget, only `palette` and `coarse` are used. */
  colour?: OrganisedColour;
  thinning?: Thinning;
  /** Every point is pure green, and no bits are spent on colour. */
  latencyTest?: boolean;
  /** Takes {@link OrganisedEncoder.depth} and {@link OrganisedEncoder.colour} instead of the frame. */
  fromImages?: boolean;
}

/** Points that were not sent, valid or not, by reason. */
export interface OrganisedReasons {
  notFinite: number;
  nonPositiveDepth: number;
  /** Beyond ±32.767 m, or nearer than the inverse depth can represent. */
  outOfRange: number;
  /** By the tiles' patterns. */
  thinned: number;
  /** How many of these were in tiles that no packet could have held. */
  tooDense: number;
  /** In packets left out because the frame would otherwise exceed its budget. */
  dropped: number;
}

export interface OrganisedReport {
  packets: number;
  points: number;
  bytes: number;
  reasons: OrganisedReasons;
  depthLevel: number;
  quality: number;
  /** Passes over the frame that the budget required. */
  passes: number;
}

const MISFITS: readonly Misfit[] = ['shape', 'too-few-points', 'no-focal-length', 'off-grid'];
const MAX_SIDE = 4080;
const REPORT_LENGTH = 20;

/**
 * Codes organised clouds: frames of a depth camera. Fill {@link frame} (or {@link depth} and {@link colour}), call
 * {@link begin} once per stream and {@link encode} for each frame, send {@link packet} 0, 1, …, the nearest first. The
 * stream header that `begin` returns must reach the decoder reliably.
 *
 * Views are recreated when the module's memory has grown: take them for each frame and do not keep them.
 */
export class OrganisedEncoder implements Disposable {
  readonly width: number;
  readonly height: number;
  readonly layout: Readonly<SlotLayout>;
  readonly #memory: Codec['memory'];
  readonly #binding: Binding;
  #begun = false;
  #id = 0;
  #packets = 0;

  /** @throws CodecError `bad-capacity`, `bad-layout` */
  constructor(
    codec: Codec,
    size: { width: number; height: number },
    layout: SlotLayout = DEFAULT_SLOT_LAYOUT,
  ) {
    checkSlotLayout(layout);
    for (const side of [size.width, size.height]) {
      if (!Number.isInteger(side) || side < 1 || side > MAX_SIDE) {
        throw new CodecError('bad-capacity', `${side} pixels, not a whole number from 1 to ${MAX_SIDE}`);
      }
    }
    const binding = Binding.create(size.width, size.height, layout.stride, layout.dataOffset);
    if (binding === undefined) throw new CodecError('bad-layout', 'a packet does not fit into its slot');
    this.width = size.width;
    this.height = size.height;
    this.layout = { ...layout };
    this.#memory = codec.memory;
    this.#binding = binding;
  }

  /** 4 floats per pixel, row by row: x, y, z in metres and the bytes R, G, B, A; invalid: NaN, infinite, or z ≤ 0. */
  get frame(): Float32Array {
    return new Float32Array(this.#memory.buffer, this.#binding.frame_ptr(), this.#pixels * 4);
  }

  /** The same memory as {@link frame}; write colours here. */
  get frameBits(): Uint32Array {
    return new Uint32Array(this.#memory.buffer, this.#binding.frame_ptr(), this.#pixels * 4);
  }

  /** Depth along z, metres, one float per pixel; invalid: NaN, infinite, or ≤ 0. */
  get depth(): Float32Array {
    const pointer = this.#binding.depth_ptr();
    return new Float32Array(this.#memory.buffer, pointer, this.#pixels);
  }

  /** R, G, B, A of each pixel, R lowest. */
  get colour(): Uint32Array {
    const pointer = this.#binding.colour_ptr();
    return new Uint32Array(this.#memory.buffer, pointer, this.#pixels);
  }

  get #pixels(): number {
    return this.width * this.height;
  }

  /**
   * Estimates the camera on whose rays the frame's points lie, by robust least squares. Takes milliseconds, so call it
   * once per stream.
   */
  estimateCamera(): GridResult {
    return this.#gridResult(this.#binding.estimate());
  }

  /** Whether each valid point of the frame lies within a tenth of a pixel (and 1 mm) of its ray. */
  checkCamera(camera: Pinhole): GridResult {
    return this.#gridResult(this.#binding.check(camera.fx, camera.fy, camera.cx, camera.cy), camera);
  }

  #gridResult(fault: number, camera?: Pinhole): GridResult {
    const [fx = 0, fy = 0, cx = 0, cy = 0] = this.#report().subarray(16);
    if (fault === 0) return { fits: true, camera: camera ?? { fx, fy, cx, cy } };
    const reason = MISFITS[fault - 1] ?? 'shape';
    return reason === 'off-grid' ? { fits: false, reason, pixels: fx } : { fits: false, reason };
  }

  /**
   * Begins a stream with the next id and returns its header. With `palette`, the present frame's colours (256 at most)
   * become the stream's palette; other colours in later frames are replaced by the most similar.
   *
   * @throws CodecError `bad-parameter`, `too-many-colours`
   */
  begin(camera: Pinhole, options: { palette?: boolean; fromImages?: boolean; id?: number } = {}): Uint8Array {
    const { palette = false, fromImages = false, id = (this.#id + 1) & 0xff } = options;
    if (!Number.isInteger(id) || id < 0 || id > 255) {
      throw new CodecError('bad-parameter', `stream id ${id} is not a whole number from 0 to 255`);
    }
    const { fx, fy, cx, cy } = camera;
    const header = this.#binding.begin(id, fx, fy, cx, cy, palette, fromImages);
    // A header that this module's decoder refuses is invalid. Without a palette, the cause is the camera.
    if (header.length === 0) {
      const code = palette ? 'too-many-colours' : 'bad-parameter';
      throw new CodecError(
        code,
        palette ? 'not 1 to 256 colours, or no camera' : 'no camera has these numbers',
      );
    }
    this.#id = id;
    this.#begun = true;
    return header;
  }

  /** @throws CodecError `no-stream`, `bad-parameter` */
  encode(options: OrganisedOptions = {}): OrganisedReport {
    if (!this.#begun) throw new CodecError('no-stream', 'no stream has been begun');
    const { thinning = {}, latencyTest = false, fromImages = false, budgetBytes } = options;
    const { lambda = 3, epsilon = 1e-6, nearDistance = 3.85 } = thinning;
    checkRange('lambda', lambda, 0, 64);
    checkRange('epsilon', epsilon, 1e-12, 1);
    checkRange('nearDistance', nearDistance, 0, 1e6);
    const colour = options.colour ?? { quality: 18 };
    let coded: boolean;
    if (budgetBytes === undefined) {
      const level = options.depthLevel ?? 3;
      checkRange('depthLevel', level, 0, 7);
      const fixed = colour === 'coarse' ? COARSE_COLOUR : colour;
      const quality = typeof fixed === 'string' ? 0 : fixed.quality;
      checkRange('quality', quality, 0, 31);
      const density = thinning.density ?? 0;
      checkRange('density', density, 0, 1e6);
      const chroma = typeof fixed === 'string' ? fixed : (fixed.chroma ?? 'half');
      const mode = COLOUR_MODES.indexOf(latencyTest ? 'none' : chroma);
      coded = this.#binding.encode(fromImages, level, mode, quality, density, lambda, epsilon, nearDistance);
    } else {
      checkRange('budgetBytes', budgetBytes, 0, 2 ** 31 - 1);
      coded = this.#binding.encode_within(
        fromImages,
        Math.floor(budgetBytes),
        latencyTest,
        Math.max(BUDGET_COLOURS.indexOf(colour), 0),
        lambda,
        epsilon,
        nearDistance,
      );
    }
    if (!coded) throw new CodecError('no-stream', 'no stream has been begun');
    const report = this.#report();
    const number = (i: number): number => report[i] ?? 0;
    this.#packets = number(0);
    return {
      packets: number(0),
      bytes: number(1),
      points: number(2),
      reasons: {
        notFinite: number(3),
        nonPositiveDepth: number(4),
        outOfRange: number(5),
        thinned: number(6),
        tooDense: number(7),
        dropped: number(8),
      },
      depthLevel: number(9),
      quality: number(10),
      passes: number(12),
    };
  }

  /**
   * The size of the last frame in one packet of any length, bits: the reference for the cost of independent packets.
   * Takes as long as coding a frame.
   */
  bitsInOnePacket(options: { fromImages?: boolean } = {}): number {
    return this.#binding.bits_in_one_packet(options.fromImages ?? false);
  }

  /** The last frame's slots, one after another, laid out according to {@link layout}. */
  get slots(): Uint8Array {
    const bytes = this.#packets * this.layout.stride;
    return new Uint8Array(this.#memory.buffer, this.#binding.slots_ptr(), bytes);
  }

  /** Bytes and points of each packet of the last frame, two numbers per packet. */
  get lengths(): Uint32Array {
    return new Uint32Array(this.#memory.buffer, this.#binding.lengths_ptr(), this.#packets * 2);
  }

  /** A view of a packet of the last frame. */
  packet(index: number): Uint8Array {
    const length = this.lengths[index * 2] ?? 0;
    const start = this.#binding.slots_ptr() + index * this.layout.stride + this.layout.dataOffset;
    return new Uint8Array(this.#memory.buffer, start, length);
  }

  /** Frees the memory; the encoder and its views must not be used afterwards. */
  [Symbol.dispose](): void {
    this.#binding.free();
  }

  #report(): Float64Array {
    return new Float64Array(this.#memory.buffer, this.#binding.report_ptr(), REPORT_LENGTH);
  }
}

function checkRange(name: string, value: number, least: number, most: number): void {
  if (!(value >= least && value <= most)) {
    throw new CodecError('bad-parameter', `${name} is ${value}, not from ${least} to ${most}`);
  }
}
