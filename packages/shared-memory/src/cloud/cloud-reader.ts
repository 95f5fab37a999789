import type { ByteView } from '../addon.ts';
import { SharedMemoryError } from '../errors.ts';
import { MappedFile } from '../mapped-file.ts';
import {
  type CloudHeader,
  cloudFile,
  colourOffset,
  type FrameHeader,
  HEADER_BYTES,
  PUBLISHED_OFFSET,
  parseFrameHeader,
  parseHeader,
  SLOT_HEADER_BYTES,
  slotOffset,
} from './layout.ts';

export interface CloudFrame extends FrameHeader {
  /** Counts from 1; it wraps at 2³². */
  frame: number;
  /** width × height, as points of 16 bytes. */
  points: number;
}

/** A frame that was overtaken while it was copied is given up after so many newer ones. */
const MOST_ATTEMPTS = 8;

/** Reads the newest frame. It only reads: no reader can hold up or harm the producer, or another reader. */
export class CloudReader implements Disposable {
  readonly file: MappedFile;
  readonly header: CloudHeader;
  /** Copies that were begun anew because the producer had come round to the same slot. */
  overtaken = 0;
  /** Frames that were never looked at because a newer one was there. */
  skipped = 0;
  readonly #slotHeader = new Uint8Array(SLOT_HEADER_BYTES);
  readonly #lens = new Float64Array(4);
  #last = 0;

  private constructor(file: MappedFile, header: CloudHeader) {
    this.file = file;
    this.header = header;
  }

  /** @throws {SharedMemoryError} */
  static open(folder?: string): CloudReader {
    const file = MappedFile.open(cloudFile(folder));
    try {
      const bytes = new Uint8Array(Math.min(HEADER_BYTES, file.bytes));
      file.copyOut(0, bytes);
      return new CloudReader(file, parseHeader(bytes, file.bytes, file.path));
    } catch (error) {
      file.close();
      throw error;
    }
  }

  /** False once another producer has taken over: open it again. */
  get current(): boolean {
    return this.file.current;
  }

  /** The newest whole frame's number; 0 before the first. */
  get published(): number {
    return this.file.load32(PUBLISHED_OFFSET);
  }

  /** The frame that was read last; what a watch waits to see exceeded. */
  get last(): number {
    return this.#last;
  }

  /**
   * The newest frame, where it is newer than the one read last.
   *
   * @param to 16 bytes a point: x, y, z as float32, then R, G, B, A. After an error it holds no frame.
   * @returns `null` where there is no newer one, or the producer has overtaken every attempt
   * @throws {SharedMemoryError} `bad-frame`, `too-large`, `truncated`; the frame then counts as read
   */
  read(to: ByteView): CloudFrame | null {
    for (let attempt = 0; attempt < MOST_ATTEMPTS; attempt++) {
      const frame = this.published;
      if (frame === this.#last) return null;
      const at = slotOffset(this.header, frame);
      const whole = (frame * 2) >>> 0;
      if (this.file.load32(at) === whole) {
        const read = this.#copy(frame, at, whole, to);
        if (read !== null) {
          if (this.#last !== 0) this.skipped += ((frame - this.#last) >>> 0) - 1;
          this.#last = frame;
          return read;
        }
      }
      this.overtaken++;
    }
    return null;
  }

  /** The newest frame counts as read. @throws {SharedMemoryError} `truncated` */
  skip(): void {
    this.#last = this.published;
  }

  close(): void {
    this.file.close();
  }

  [Symbol.dispose](): void {
    this.close();
  }

  /** `null` where the slot was written to meanwhile. */
  #copy(frame: number, at: number, whole: number, to: ByteView): CloudFrame | null {
    const { file } = this;
    let header: FrameHeader;
    try {
      file.copyOut(at, this.#slotHeader);
      header = parseFrameHeader(this.#slotHeader, this.header, file.path, at);
      this.#copyPoints(header, at, to);
    } catch (error) {
      // What cannot be may be the half of a newer frame.
      file.fence();
      if (file.load32(at) !== whole) return null;
      this.#last = frame;
      throw error;
    }
    file.fence();
    if (file.load32(at) !== whole) return null;
    return { frame, points: header.width * header.height, ...header };
  }

  #copyPoints({ width, height, lens, depthUnit }: FrameHeader, at: number, to: ByteView): void {
    const { file } = this;
    const { format } = this.header;
    const points = width * height;
    if (points * 16 > to.byteLength) {
      const room = Math.floor(to.byteLength / 16);
      throw new SharedMemoryError(
        'too-large',
        file.path,
        at + 16,
        `${width} × ${height} points, room for ${room}`,
      );
    }
    const payload = at + SLOT_HEADER_BYTES;
    if (lens === null || format === 'points') {
      file.copyOut(payload, new Uint8Array(to.buffer, to.byteOffset, points * 16));
      return;
    }
    this.#lens.set([lens.fx, lens.fy, lens.cx, lens.cy]);
    const colours = payload + colourOffset(format, points);
    file.unproject(payload, colours, width, height, depthUnit, this.#lens, to);
  }
}
