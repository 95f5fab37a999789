import type { CaptureRoom, SourceDescription, SourceFrame } from '@farpoint/cloud-source';
import { type Codec, type GridResult, OrganisedEncoder, type Pinhole } from '@farpoint/wasm-codec';
import {
  type EncodedFrame,
  type EncoderOptions,
  isSameMemory,
  type PacketSource,
  placementOf,
  roomOf,
} from './encoded-frame.ts';
import { Packetiser, SLOT_BYTES, SLOT_DATA_OFFSET } from './packetiser.ts';

/** Encodes a depth camera's frame into complete `organised` packets (docs/organised-codec.md). */
export class OrganisedFrameEncoder implements PacketSource {
  readonly #encoder: OrganisedEncoder;
  readonly #sampling: EncoderOptions;
  readonly #now: () => number;
  readonly #packetiser = new Packetiser();
  readonly room: CaptureRoom;
  #camera: Pinhole | null = null;
  /** The stream's header; `null` before the first frame that fits. */
  header: Uint8Array | null = null;

  /** @throws {CodecError} for a grid that is too large for the format */
  constructor(
    codec: Codec,
    source: Pick<SourceDescription, 'width' | 'height'>,
    sampling: EncoderOptions,
    now: () => number,
  ) {
    const { width, height } = source;
    this.#encoder = new OrganisedEncoder(
      codec,
      { width, height },
      { stride: SLOT_BYTES, dataOffset: SLOT_DATA_OFFSET },
    );
    this.room = roomOf(this.#encoder);
    this.#sampling = sampling;
    this.#now = now;
  }

  /**
   * Takes a frame. Begins a new stream at the first frame of a camera.
   *
   * @param camera of images; for points, it is estimated from them
   * @returns false if the points do not lie on a camera's grid
   */
  take(frame: SourceFrame, camera: Pinhole | null): boolean {
    const encoder = this.#encoder;
    const fromImages = frame.form === 'images';
    if (frame.form === 'images') {
      if (!isSameMemory(frame.depth, encoder.depth)) encoder.depth.set(frame.depth);
      if (!isSameMemory(frame.colour, encoder.colour)) encoder.colour.set(frame.colour);
    } else {
      if (frame.count !== encoder.width * encoder.height) return false;
      const words = new Uint32Array(frame.points.buffer, frame.points.byteOffset, frame.count * 4);
      if (!isSameMemory(words, encoder.frameBits)) encoder.frameBits.set(words);
    }
    if (this.#camera !== null && (fromImages || encoder.checkCamera(this.#camera).fits)) return true;
    const grid: GridResult = camera !== null && fromImages ? { fits: true, camera } : this.#estimateCamera();
    if (!grid.fits) return false;
    this.#camera = grid.camera;
    this.header = encoder.begin(grid.camera, { fromImages });
    return true;
  }

  #estimateCamera(): GridResult {
    const estimate = this.#encoder.estimateCamera();
    return estimate.fits ? this.#encoder.checkCamera(estimate.camera) : estimate;
  }

  /**
   * Encodes the frame that was taken.
   *
   * @param budgetBytes for the data of all packets
   * @param latencyTest makes the whole frame green
   */
  encode(frame: SourceFrame, frameNumber: number, budgetBytes: number, latencyTest: boolean): EncodedFrame {
    const encoder = this.#encoder;
    const begin = this.#now();
    const { lambda, epsilon, nearDistance } = this.#sampling;
    const report = encoder.encode({
      budgetBytes,
      latencyTest,
      fromImages: frame.form === 'images',
      thinning: { lambda, epsilon, nearDistance },
    });
    const { lengths } = encoder;
    const placement = placementOf(frame, 'organised', this.#sampling.sensor, latencyTest, false);
    this.#packetiser.begin(encoder.slots, frameNumber, report.points, placement);
    for (let i = 0; i < report.packets; i++) {
      this.#packetiser.add(lengths[i * 2 + 1] as number, lengths[i * 2] as number);
    }
    const { notFinite, nonPositiveDepth, outOfRange, thinned, dropped } = report.reasons;
    const notDrawn = thinned + dropped;
    return {
      format: 'organised',
      frameNumber,
      points: report.points,
      packets: report.packets,
      validPoints: report.points + notDrawn,
      rejected: { notFinite, nonPositiveDepth, outOfRange, notDrawn },
      saturated: 0,
      sampleMs: 0,
      packMs: this.#now() - begin,
    };
  }

  copyPackets(into: Uint8Array, packets: number): void {
    into.set(this.#encoder.slots.subarray(0, packets * SLOT_BYTES));
  }
}
