import type { CaptureRoom, PointFrame, SourceDescription, SourceFrame } from '@farpoint/cloud-source';
import { encodeUnorganisedStream } from '@farpoint/protocol';
import { type Codec, CodecError, UnorganisedEncoder } from '@farpoint/wasm-codec';
import {
  type EncodedFrame,
  type EncoderOptions,
  isSameMemory,
  type PacketSource,
  placementOf,
} from './encoded-frame.ts';
import { OrganisedFrameEncoder } from './organised-frame-encoder.ts';
import { Packetiser, SLOT_BYTES, SLOT_DATA_OFFSET } from './packetiser.ts';
import type { CodedFormat } from './plan.ts';

/** Quantisation step, mm. The error of a coordinate is at most half of it. */
const STEP_MM = 10;
/** The largest multiple of the receiver's unit that int16 holds. */
const MOST_UNITS = 32_767;
/** The format refuses coordinates beyond this, m. */
const MOST_METRES = 500;

/** Encodes a frame of points without a grid into complete `unorganised` packets (docs/unorganised-codec.md). */
class UnorganisedFrameEncoder implements PacketSource {
  readonly #encoder: UnorganisedEncoder;
  readonly #lambda: number;
  readonly #sensor: number;
  readonly #now: () => number;
  readonly #packetiser = new Packetiser();
  readonly room: CaptureRoom;
  #slots = new Uint8Array(0);
  #unitMm = 0;
  /** The stream's header, with the unit of the receivers' coordinates. The unit grows when a frame extends further. */
  header: Uint8Array | null = null;

  constructor(codec: Codec, capacity: number, sampling: EncoderOptions, now: () => number) {
    const encoder = new UnorganisedEncoder(codec, capacity);
    this.#encoder = encoder;
    this.room = {
      get points() {
        return encoder.frame;
      },
      depth: new Float32Array(0),
      colour: new Uint32Array(0),
    };
    this.#lambda = sampling.lambda;
    this.#sensor = sampling.sensor;
    this.#now = now;
  }

  /**
   * @param budgetBytes for the data of all packets
   * @param latencyTest makes the whole frame green
   * @throws {CodecError} for a frame beyond the capacity
   */
  encode(frame: PointFrame, frameNumber: number, budgetBytes: number, latencyTest: boolean): EncodedFrame {
    const encoder = this.#encoder;
    const begin = this.#now();
    const words = new Uint32Array(frame.points.buffer, frame.points.byteOffset, frame.count * 4);
    const { frameBits } = encoder;
    if (!isSameMemory(words, frameBits)) frameBits.set(words);
    if (latencyTest) for (let i = 3; i < words.length; i += 4) frameBits[i] = 0xff00_ff00;
    this.#chooseUnit(frame);
    const middle = this.#now();
    const report = encoder.encode({
      points: frame.count,
      stepMm: STEP_MM,
      attribute: 'colour',
      budgetBytes: Math.max(1, Math.floor(budgetBytes)),
      lambda: Math.min(this.#lambda, 8),
    });
    if (this.#slots.length < report.packets * SLOT_BYTES) {
      this.#slots = new Uint8Array(Math.ceil(report.packets * 1.25) * SLOT_BYTES);
    }
    const placement = placementOf(frame, 'unorganised', this.#sensor, latencyTest, false);
    this.#packetiser.begin(this.#slots, frameNumber, report.kept, placement);
    for (let i = 0; i < report.packets; i++) {
      const packet = encoder.packet(i);
      this.#slots.set(packet, i * SLOT_BYTES + SLOT_DATA_OFFSET);
      this.#packetiser.add(encoder.pointsOf(i), packet.length);
    }
    const { notFinite, outOfRange } = report.rejected;
    return {
      format: 'unorganised',
      frameNumber,
      points: report.kept,
      packets: report.packets,
      validPoints: report.kept + report.thinned,
      rejected: { notFinite, nonPositiveDepth: 0, outOfRange, notDrawn: report.thinned },
      saturated: 0,
      sampleMs: middle - begin,
      packMs: this.#now() - middle,
    };
  }

  copyPackets(into: Uint8Array, packets: number): void {
    into.set(this.#slots.subarray(0, packets * SLOT_BYTES));
  }

  /** Chooses the finest unit, a power of two in millimetres, in which the farthest point fits. */
  #chooseUnit({ points, count }: PointFrame): void {
    let most = 0;
    for (let i = 0; i < count * 4; i += 4) {
      for (let axis = 0; axis < 3; axis++) {
        const metres = Math.abs(points[i + axis] as number);
        if (metres > most && metres <= MOST_METRES) most = metres;
      }
    }
    let unitMm = Math.max(this.#unitMm, 1);
    while (most * 1000 > unitMm * MOST_UNITS) unitMm *= 2;
    if (unitMm === this.#unitMm) return;
    this.#unitMm = unitMm;
    this.header = encodeUnorganisedStream({ unitMm });
  }
}

/** What receivers need before the packets of a format. */
export interface CodedStream {
  format: CodedFormat;
  header: Uint8Array;
}

/**
 * Encodes a frame in the best of our own formats: `organised` if it lies on a camera's grid, otherwise `unorganised`.
 */
export class CodedFrameEncoder {
  readonly #codec: Codec;
  readonly #source: SourceDescription;
  readonly #sampling: EncoderOptions;
  readonly #now: () => number;
  readonly #organised: OrganisedFrameEncoder | null;
  #unorganised: UnorganisedFrameEncoder | null = null;
  #last: (PacketSource & { header: Uint8Array | null }) | null = null;
  #stream: CodedStream | null = null;

  constructor(codec: Codec, source: SourceDescription, sampling: EncoderOptions, now: () => number) {
    this.#codec = codec;
    this.#source = source;
    this.#sampling = sampling;
    this.#now = now;
    this.#organised = source.height > 1 ? this.#makeOrganised() : null;
  }

  /** The best place for the next frame: the memory of the encoder that the last frame used. */
  get room(): CaptureRoom {
    return (this.#last ?? this.#organised ?? this.#makeUnorganised()).room;
  }

  /** The most likely format of the next frame; `null` if none of `allowed` is possible. */
  likelyFormat(allowed: readonly CodedFormat[]): CodedFormat | null {
    const last = this.#stream?.format;
    if (last !== undefined && allowed.includes(last)) return last;
    if (this.#organised !== null && allowed.includes('organised')) return 'organised';
    return this.#source.camera === null && allowed.includes('unorganised') ? 'unorganised' : null;
  }

  /** The stream of the last frame. A new object whenever it changes. */
  get stream(): CodedStream | null {
    return this.#stream;
  }

  /**
   * @param allowed the formats that somebody reads
   * @param budgetBytes for the data of all packets
   * @param latencyTest makes the whole frame green
   * @returns `null` if `points64` is the only format for this frame
   * @throws {CodecError} for a frame beyond the capacity
   */
  encode(
    frame: SourceFrame,
    frameNumber: number,
    allowed: readonly CodedFormat[],
    budgetBytes: number,
    latencyTest: boolean,
  ): EncodedFrame | null {
    if (allowed.includes('organised') && this.#organised?.take(frame, this.#source.camera) === true) {
      const encoded = this.#organised.encode(frame, frameNumber, budgetBytes, latencyTest);
      this.#used(this.#organised, 'organised');
      return encoded;
    }
    if (frame.form === 'images' || !allowed.includes('unorganised')) return null;
    // Creating the encoder may move the codec's memory, and with it a frame that lies there.
    const kept =
      this.#unorganised === null ? { ...frame, points: frame.points.slice(0, frame.count * 4) } : frame;
    const encoder = this.#makeUnorganised();
    const encoded = encoder.encode(kept, frameNumber, budgetBytes, latencyTest);
    this.#used(encoder, 'unorganised');
    return encoded;
  }

  #used(encoder: PacketSource & { header: Uint8Array | null }, format: CodedFormat): void {
    this.#last = encoder;
    const { header } = encoder;
    if (header !== null && header !== this.#stream?.header) this.#stream = { format, header };
  }

  copyPackets(into: Uint8Array, packets: number): void {
    this.#last?.copyPackets(into, packets);
  }

  #makeUnorganised(): UnorganisedFrameEncoder {
    this.#unorganised ??= new UnorganisedFrameEncoder(
      this.#codec,
      this.#source.capacity,
      this.#sampling,
      this.#now,
    );
    return this.#unorganised;
  }

  /** `null` for a grid that is too large for the format. */
  #makeOrganised(): OrganisedFrameEncoder | null {
    try {
      return new OrganisedFrameEncoder(this.#codec, this.#source, this.#sampling, this.#now);
    } catch (error) {
      if (error instanceof CodecError) return null;
      throw error;
    }
  }
}
