import { BYTES_PER_POINT } from '@farpoint/protocol';
import { SharedMemoryError } from '../errors.ts';
import { MappedFile } from '../mapped-file.ts';
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

/** The producer's end of `shared_pc` and `semaphore_read`. */
export class ReferenceFrameProducer implements Disposable {
  readonly flags: MappedFile;
  readonly #cloud: MappedFile;
  readonly #length = new Uint8Array(LENGTH_BYTES);

  /**
   * Creates the files, or continues with existing ones: if the flag is set, they contain a complete frame that waits
   * for the consumer; if not, their content is ignored.
   *
   * @throws {SharedMemoryError}
   */
  constructor(folder?: string, mode = 0o600) {
    const paths = referenceFiles(folder);
    this.#cloud = MappedFile.open(paths.cloud, { bytes: CLOUD_BYTES, create: true, mode });
    this.flags = MappedFile.open(paths.flags, { bytes: FLAG_BYTES, create: true, mode });
  }

  /** Whether the consumer has taken the last frame. */
  get free(): boolean {
    return this.flags.load8(READY_OFFSET) === 0;
  }

  /** The consumer's latest request: bit/s, and whether the next frame should be green. */
  get wishes(): { bitsPerSecond: number; latencyTest: boolean } {
    const rate = new Uint8Array(4);
    this.flags.copyOut(BITRATE_OFFSET, rate);
    return {
      bitsPerSecond: new DataView(rate.buffer).getUint32(0, true),
      latencyTest: this.flags.load8(LATENCY_OFFSET) === 1,
    };
  }

  /**
   * Writes a frame if the last one was taken.
   *
   * @param packed blocks of 150 points, as they are sent
   * @returns whether it was written
   * @throws {SharedMemoryError} `bad-length`, `truncated`
   */
  publish(packed: Uint8Array): boolean {
    const { length } = packed;
    if (length > MAX_PAYLOAD_BYTES || length % BYTES_PER_POINT !== 0) {
      throw new SharedMemoryError('bad-length', this.#cloud.path, 0, `${length} bytes cannot be a payload`);
    }
    if (!this.free) return false;
    this.#length[0] = length & 0xff;
    this.#length[1] = (length >> 8) & 0xff;
    this.#length[2] = length >> 16;
    this.#cloud.copyIn(0, this.#length);
    this.#cloud.copyIn(LENGTH_BYTES, packed);
    this.flags.store8(READY_OFFSET, 1);
    return true;
  }

  close(): void {
    this.#cloud.close();
    this.flags.close();
  }

  [Symbol.dispose](): void {
    this.close();
  }
}
