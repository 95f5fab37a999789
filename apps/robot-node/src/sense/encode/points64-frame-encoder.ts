import type { CaptureRoom, SourceDescription, SourceFrame } from '@farpoint/cloud-source';
import { type Codec, Points64Encoder, type SampleReport } from '@farpoint/wasm-codec';
import {
  type EncodedFrame,
  type EncoderOptions,
  isSameMemory,
  type PacketSource,
  placementOf,
  roomOf,
} from './encoded-frame.ts';
import { completePackets, Packetiser, SLOT_BYTES, SLOT_DATA_OFFSET } from './packetiser.ts';

/** Encodes a source's frame into complete `points64` packets: sample, pack, add header and placement. */
export class Points64FrameEncoder implements PacketSource {
  readonly #encoder: Points64Encoder;
  readonly #sampling: EncoderOptions;
  readonly #now: () => number;
  readonly #packetiser = new Packetiser();
  readonly room: CaptureRoom;

  constructor(
    codec: Codec,
    source: Pick<SourceDescription, 'capacity' | 'width' | 'height' | 'camera'>,
    sampling: EncoderOptions,
    now: () => number,
  ) {
    const { capacity, width, height, camera } = source;
    this.#encoder = new Points64Encoder(codec, capacity, {
      stride: SLOT_BYTES,
      dataOffset: SLOT_DATA_OFFSET,
    });
    if (camera !== null) this.#encoder.setCamera({ width, height, ...camera });
    this.room = roomOf(this.#encoder);
    this.#sampling = sampling;
    this.#now = now;
  }

  /**
   * @param count maximum number of points to send
   * @param latencyTest makes the whole frame green
   * @throws {CodecError} for a frame beyond the capacity
   */
  encode(frame: SourceFrame, frameNumber: number, count: number, latencyTest: boolean): EncodedFrame {
    const encoder = this.#encoder;
    const begin = this.#now();
    const parameters = { ...this.#sampling, count, seed: frameNumber };
    let sampled: SampleReport;
    if (frame.form === 'images') {
      if (!isSameMemory(frame.depth, encoder.depth)) encoder.depth.set(frame.depth);
      if (!isSameMemory(frame.colour, encoder.colour)) encoder.colour.set(frame.colour);
      sampled = encoder.sampleImages(parameters);
    } else {
      // Copied as words: copying a colour as a float may change the bits of a NaN.
      const words = new Uint32Array(frame.points.buffer, frame.points.byteOffset, frame.count * 4);
      if (!isSameMemory(words, encoder.frameBits)) encoder.frameBits.set(words);
      sampled = encoder.sample({ ...parameters, points: frame.count });
    }
    const middle = this.#now();
    const packed = encoder.pack({ order: 'near-first', latencyTest });
    const placement = placementOf(
      frame,
      'points64',
      this.#sampling.sensor,
      latencyTest,
      packed.saturated > 0,
    );
    const packets = completePackets(encoder.packets, frameNumber, packed.points, placement, this.#packetiser);
    return {
      format: 'points64',
      frameNumber,
      points: packed.points,
      packets,
      validPoints: sampled.kept + sampled.rejected.notDrawn,
      rejected: sampled.rejected,
      saturated: packed.saturated,
      sampleMs: middle - begin,
      packMs: this.#now() - middle,
    };
  }

  copyPackets(into: Uint8Array, packets: number): void {
    into.set(this.#encoder.packets.subarray(0, packets * SLOT_BYTES));
  }
}
