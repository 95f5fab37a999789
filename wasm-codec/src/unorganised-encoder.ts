/** Encodes a frame of points without a grid to `unorganised` packets (docs/unorganised-codec.md). */
import { UnorganisedEncoder as WasmEncoder } from '../pkg/farpoint_codec.js';
import type { Codec } from './codec.ts';
import { CodecError } from './errors.ts';
import { checkCapacity } from './slot-layout.ts';

/** What the fourth word of a point contains. */
export type UnorganisedAttribute = 'none' | 'colour' | 'intensity8' | 'intensity16';
const ATTRIBUTES: readonly UnorganisedAttribute[] = ['none', 'colour', 'intensity8', 'intensity16'];

/**
 * The order of the points: unchanged (`given`), ring by ring around the axis along which the cloud is flattest
 * (`sweep`), along a Morton curve (`morton`), or (`auto`) unchanged if that is already an order, else the cheaper one.
 */
export type UnorganisedOrder = 'auto' | 'given' | 'sweep' | 'morton';
const ORDERS: readonly UnorganisedOrder[] = ['auto', 'given', 'sweep', 'morton'];

export interface UnorganisedSettings {
  /** How many points of the frame are filled, from its beginning. */
  points: number;
  /** The grid's step, integer millimetres from 1 to 100; a coordinate's error is at most half of it. Default 10. */
  stepMm?: number;
  /** Default `colour`. */
  attribute?: UnorganisedAttribute;
  /** Default `auto`. */
  order?: UnorganisedOrder;
  /** 128 to 1200, default 1200. */
  maxPacketBytes?: number;
  /** Points are left out until all packets together do not exceed this. Default: none are left out. */
  budgetBytes?: number;
  /**
   * With a budget: how fast the fraction of kept points falls with range beyond 4 m: range^−lambda, 0 to 8. Default 0:
   * uniform.
   */
  lambda?: number;
}

export interface UnorganisedReport {
  /** Points in the packets. */
  kept: number;
  /** Points left out for the budget. */
  thinned: number;
  rejected: {
    /** A coordinate is NaN or infinite. */
    notFinite: number;
    /** A coordinate is beyond ±500 m. */
    outOfRange: number;
  };
  packets: number;
  /** Size of all packets together. */
  bytes: number;
}

const FAULTS = [
  'stepMm is not a whole number from 1 to 100',
  'maxPacketBytes is not between 128 and 1200',
  'lambda is not between 0 and 8',
] as const;

/**
 * Encodes frames: fill {@link frame}, call {@link encode}, send {@link packet} 0, 1, 2 …, those nearest to the sensor
 * first. Take the views from the encoder for each frame and do not keep them: the memory moves when it grows.
 */
export class UnorganisedEncoder implements Disposable {
  readonly capacityPoints: number;
  readonly #memory: Codec['memory'];
  readonly #encoder: WasmEncoder;
  #packets = 0;

  /** @throws CodecError `bad-capacity` */
  constructor(codec: Codec, capacityPoints: number) {
    checkCapacity('capacityPoints', capacityPoints);
    this.capacityPoints = capacityPoints;
    this.#memory = codec.memory;
    this.#encoder = WasmEncoder.create(capacityPoints);
  }

  /** 4 floats per point: x, y, z in metres with the sensor at the origin; the fourth as in {@link frameBits}. */
  get frame(): Float32Array {
    return new Float32Array(this.#memory.buffer, this.#encoder.frame_ptr(), this.capacityPoints * 4);
  }

  /**
   * The same memory as 32-bit words; the fourth is the bytes R, G, B, A from the lowest, or an 8- or 16-bit intensity.
   */
  get frameBits(): Uint32Array {
    return new Uint32Array(this.#memory.buffer, this.#encoder.frame_ptr(), this.capacityPoints * 4);
  }

  /** @throws CodecError `bad-count`, `too-many-points`, `bad-parameter` */
  encode(settings: UnorganisedSettings): UnorganisedReport {
    const { points, budgetBytes = 0, stepMm = 10, maxPacketBytes = 1200, lambda = 0 } = settings;
    this.#packets = 0;
    checkWhole('points', points, 0);
    if (points > this.capacityPoints) {
      throw new CodecError('too-many-points', `${points} points: more than the capacity`);
    }
    checkWhole('stepMm', stepMm, 1);
    checkWhole('maxPacketBytes', maxPacketBytes, 1);
    if (settings.budgetBytes !== undefined) checkWhole('budgetBytes', budgetBytes, 1);
    const fault = this.#encoder.encode(
      points,
      stepMm,
      ATTRIBUTES.indexOf(settings.attribute ?? 'colour'),
      ORDERS.indexOf(settings.order ?? 'auto'),
      maxPacketBytes,
      budgetBytes,
      lambda,
    );
    if (fault !== 0) throw new CodecError('bad-parameter', FAULTS[fault - 1] ?? 'too many points');
    const report = new Uint32Array(this.#memory.buffer, this.#encoder.report_ptr(), 6);
    const [kept, thinned, notFinite, outOfRange, packets, bytes] = report as unknown as [
      number,
      number,
      number,
      number,
      number,
      number,
    ];
    this.#packets = packets;
    return { kept, thinned, rejected: { notFinite, outOfRange }, packets, bytes };
  }

  /** Number of packets of the last frame. */
  get packetCount(): number {
    return this.#packets;
  }

  /**
   * The i-th packet's bytes, at most 1200: a view that is valid until the next call.
   *
   * @throws CodecError `bad-count` if there is no such packet
   */
  packet(i: number): Uint8Array {
    if (!Number.isInteger(i) || i < 0 || i >= this.#packets) {
      throw new CodecError('bad-count', `packet ${i} of ${this.#packets}`);
    }
    const { buffer } = this.#memory;
    const extents = new Uint32Array(buffer, this.#encoder.extents_ptr() + i * 12, 3);
    return new Uint8Array(buffer, this.#encoder.bytes_ptr() + (extents[0] as number), extents[1]);
  }

  /** Number of points of the i-th packet. */
  pointsOf(i: number): number {
    if (!Number.isInteger(i) || i < 0 || i >= this.#packets) return 0;
    return new Uint32Array(this.#memory.buffer, this.#encoder.extents_ptr() + i * 12, 3)[2] as number;
  }

  /** Frees the memory; the encoder and its views must not be used afterwards. */
  [Symbol.dispose](): void {
    this.#encoder.free();
  }
}

function checkWhole(name: string, value: number, least: number): void {
  if (!Number.isInteger(value) || value < least || value > 0x7fff_ffff) {
    throw new CodecError('bad-count', `${name} is ${value}, not a whole number from ${least} on`);
  }
}
