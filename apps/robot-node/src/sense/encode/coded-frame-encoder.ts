import type { CaptureRoom, SourceDescription, SourceFrame } from '@farpoint/cloud-source';
import { type Codec, CodecError } from '@farpoint/wasm-codec';
import type { EncodedFrame, EncoderOptions, PacketSource } from './encoded-frame.ts';
import { OrganisedFrameEncoder } from './organised-frame-encoder.ts';
import type { CodedFormat } from './plan.ts';
import { UnorganisedFrameEncoder } from './unorganised-frame-encoder.ts';

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
