import { BYTES_PER_POINT, pointsOfBytes } from '@farpoint/protocol';
import type { ByteView } from '../addon.ts';
import { SharedMemoryError } from '../errors.ts';
import { MappedFile, type TrustedOwner } from '../mapped-file.ts';
import {
  BITRATE_OFFSET,
  CLOUD_BYTES,
  FLAG_BYTES,
  LATENCY_OFFSET,
  LENGTH_BYTES,
  MAX_PAYLOAD_BYTES,
  READY_OFFSET,
  referenceFiles,
} from './layout.ts';

/** What the consumer requests from the producer with each frame it takes. */
export interface ConsumerWishes {
  /** Bit rate that the next frames should fit, bit/s. */
  bitsPerSecond: number;
  /** Whether the next frame should be green. */
  latencyTest: boolean;
}

export interface ConsumedFrame {
  points: number;
  /** Every point has the latency test's colour. */
  green: boolean;
}

/** The consumer's end of `shared_pc` and `semaphore_read`. */
export class ReferenceFrameConsumer implements Disposable {
  readonly flags: MappedFile;
  readonly #cloud: MappedFile;
  readonly #length = new Uint8Array(LENGTH_BYTES);
  readonly #rate = new Uint8Array(4);

  private constructor(cloud: MappedFile, flags: MappedFile) {
    this.#cloud = cloud;
    this.flags = flags;
  }

  /** @throws {SharedMemoryError} naming the invalid file */
  static open(folder?: string, owner?: TrustedOwner): ReferenceFrameConsumer {
    const paths = referenceFiles(folder);
    const cloud = MappedFile.open(paths.cloud, { bytes: CLOUD_BYTES, owner });
    try {
      return new ReferenceFrameConsumer(
        cloud,
        MappedFile.open(paths.flags, { bytes: FLAG_BYTES, writable: true, owner }),
      );
    } catch (error) {
      cloud.close();
      throw error;
    }
  }

  /** False once a producer has recreated the files: open them again. */
  get current(): boolean {
    return this.#cloud.current && this.flags.current;
  }

  get ready(): boolean {
    return this.flags.load8(READY_OFFSET) !== 0;
  }

  /**
   * Takes the frame that is ready and lets the producer make the next one. An invalid frame is also released, because
   * otherwise the producer would wait for ever.
   *
   * @param to 16 bytes for each point, for the maximum number of points
   * @returns `null` if no frame is ready
   * @throws {SharedMemoryError} `bad-length`, `truncated`
   */
  take(to: ByteView, wishes: ConsumerWishes): ConsumedFrame | null {
    if (!this.ready) return null;
    try {
      const bytes = this.#payloadBytes();
      const green = this.#cloud.unpackPoints64(LENGTH_BYTES, bytes, to);
      return { points: pointsOfBytes(bytes), green };
    } finally {
      this.release(wishes);
    }
  }

  /** Lets the producer make the next frame. */
  release({ bitsPerSecond, latencyTest }: ConsumerWishes): void {
    const rate = Math.min(Math.max(Math.floor(bitsPerSecond), 0), 0xffff_ffff);
    new DataView(this.#rate.buffer).setUint32(0, rate, true);
    this.flags.copyIn(BITRATE_OFFSET, this.#rate);
    this.flags.store8(LATENCY_OFFSET, latencyTest ? 1 : 0);
    this.flags.store8(READY_OFFSET, 0);
  }

  close(): void {
    this.#cloud.close();
    this.flags.close();
  }

  [Symbol.dispose](): void {
    this.close();
  }

  #payloadBytes(): number {
    this.#cloud.copyOut(0, this.#length);
    const [low = 0, middle = 0, high = 0] = this.#length;
    const bytes = low | (middle << 8) | (high << 16);
    if (bytes > MAX_PAYLOAD_BYTES)
      throw this.#badLength(`a payload of ${bytes} bytes, ${MAX_PAYLOAD_BYTES} is the most`);
    if (bytes % BYTES_PER_POINT !== 0)
      throw this.#badLength(`a payload of ${bytes} bytes, which are no whole points`);
    return bytes;
  }

  #badLength(detail: string): SharedMemoryError {
    return new SharedMemoryError('bad-length', this.#cloud.path, 0, detail);
  }
}
