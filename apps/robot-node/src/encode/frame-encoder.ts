import type { Placement } from '@farpoint/protocol';
import { CloudEncoder, type Codec, type RejectedPoints, type SampleReport } from '@farpoint/wasm-codec';
import type { CaptureRoom, SourceDescription, SourceFrame } from '../capture/frame-source.ts';
import { completePackets, SLOT_BYTES } from './packetiser.ts';

/** The paper's weights (equations 4 and 5). */
export interface SamplingOptions {
  lambda: number;
  epsilon: number;
  /** D, metres. */
  nearDistance: number;
  depthMeasure: 'z' | 'range';
}

export interface EncodedFrame {
  frameNumber: number;
  points: number;
  packets: number;
  /** Points of the raw cloud that could have been sent. */
  validPoints: number;
  rejected: RejectedPoints;
  saturated: number;
  sampleMs: number;
  packMs: number;
}

/** From a source's frame to finished packets: sample, pack, header and placement. */
export class FrameEncoder {
  readonly #encoder: CloudEncoder;
  readonly #sampling: SamplingOptions;
  readonly #now: () => number;
  #frameNumber = 0;

  constructor(
    codec: Codec,
    source: Pick<SourceDescription, 'capacity' | 'width' | 'height' | 'camera'>,
    sampling: SamplingOptions,
    now: () => number,
  ) {
    const { capacity, width, height, camera } = source;
    this.#encoder = new CloudEncoder(codec, capacity, { stride: SLOT_BYTES, dataOffset: 16 });
    if (camera !== null) this.#encoder.setCamera({ width, height, ...camera });
    this.#sampling = sampling;
    this.#now = now;
  }

  /**
   * @param count how many points to send at most
   * @param latencyTest makes the whole frame green
   * @throws {CodecError} for a frame beyond the capacity
   */
  encode(frame: SourceFrame, count: number, latencyTest: boolean): EncodedFrame {
    const encoder = this.#encoder;
    const begin = this.#now();
    const frameNumber = this.#frameNumber;
    const parameters = { ...this.#sampling, count, seed: frameNumber };
    let sampled: SampleReport;
    if (frame.form === 'images') {
      if (!isSame(frame.depth, encoder.depth)) encoder.depth.set(frame.depth);
      if (!isSame(frame.colour, encoder.colour)) encoder.colour.set(frame.colour);
      sampled = encoder.sampleImages(parameters);
    } else {
      // As words: copying a colour as a float may change the bits of a NaN.
      const words = new Uint32Array(frame.points.buffer, frame.points.byteOffset, frame.count * 4);
      if (!isSame(words, encoder.frameBits)) encoder.frameBits.set(words);
      sampled = encoder.sample({ ...parameters, points: frame.count });
    }
    const middle = this.#now();
    const packed = encoder.pack({ order: 'near-first', latencyTest });
    const placement: Placement = {
      pose: frame.cameraPose,
      captureTimeUs: Math.floor((frame.captureMs * 1000) % 0x1_0000_0000),
      latencyTest,
      saturated: packed.saturated > 0,
      sensor: 0,
    };
    const packets = completePackets(encoder.packets, frameNumber, packed.points, placement);
    this.#frameNumber = (frameNumber + 1) >>> 0;
    return {
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

  /** The codec's own memory: a frame that lies there already is not copied. */
  get room(): CaptureRoom {
    const { frame, depth, colour } = this.#encoder;
    return { points: frame, depth, colour };
  }

  /** Copies the packets of the last encoded frame out of the codec's memory. */
  copyPackets(into: Uint8Array, packets: number): void {
    into.set(this.#encoder.packets.subarray(0, packets * SLOT_BYTES));
  }
}

function isSame(frame: ArrayBufferView, memory: ArrayBufferView): boolean {
  return frame.buffer === memory.buffer && frame.byteOffset === memory.byteOffset;
}
