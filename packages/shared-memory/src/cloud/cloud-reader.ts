import { sequence32Of } from '@farpoint/protocol';
import { SharedMemoryError } from '../errors.ts';
import { MappedFile, type TrustedOwner } from '../mapped-file.ts';
import {
  type CloudHeader,
  cloudFile,
  colourOffset,
  completeLock,
  type FrameHeader,
  HEADER_BYTES,
  PUBLISHED_OFFSET,
  parseFrameHeader,
  parseHeader,
  SLOT_HEADER_BYTES,
  slotOffset,
} from './layout.ts';

/** Where a frame is stored; buffers for the other form are left unchanged. */
export interface FrameRoom {
  /** 4 floats per point: x, y, z in metres, and the bytes R, G, B, A. */
  points: Float32Array;
  /** Metres along z, per pixel. */
  depth: Float32Array;
  /** R, G, B, A of each pixel, R lowest. */
  colour: Uint32Array;
}

export interface CloudFrame extends FrameHeader {
  /** Counts from 1; wraps at 2³². */
  frame: number;
  /** The form it was read as: `images` for a camera with a lens, else `points`. */
  form: 'points' | 'images';
  /** width × height. */
  points: number;
}

/** If a frame is overtaken while it is copied, reading is given up after this many newer frames. */
const MOST_ATTEMPTS = 8;

/** Reads the newest frame. It only reads, so no reader can block or harm the producer or another reader. */
export class CloudReader implements Disposable {
  readonly file: MappedFile;
  readonly header: CloudHeader;
  /** Copies that were restarted because the producer had returned to the same slot. */
  overtaken = 0;
  /** Frames that were never read because a newer one was available. */
  skipped = 0;
  readonly #slotHeader = new Uint8Array(SLOT_HEADER_BYTES);
  #last = 0;

  private constructor(file: MappedFile, header: CloudHeader) {
    this.file = file;
    this.header = header;
  }

  /** @throws {SharedMemoryError} */
  static open(folder?: string, owner?: TrustedOwner): CloudReader {
    const file = MappedFile.open(cloudFile(folder), { owner });
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

  /** Number of the newest complete frame; 0 before the first. */
  get published(): number {
    return this.file.load32(PUBLISHED_OFFSET);
  }

  /** Number of the frame that was read last; a watch waits for it to be exceeded. */
  get last(): number {
    return this.#last;
  }

  /**
   * Reads the newest frame if it is newer than the one read last.
   *
   * @param to its content is undefined after an error, or if there is no frame
   * @returns `null` if there is no newer frame, or the producer has overtaken every attempt
   * @throws {SharedMemoryError} `bad-frame`, `too-large`, `truncated`; the frame then counts as read
   */
  read(to: FrameRoom): CloudFrame | null {
    for (let attempt = 0; attempt < MOST_ATTEMPTS; attempt++) {
      const frame = this.published;
      if (frame === this.#last) return null;
      const at = slotOffset(this.header, frame);
      const whole = completeLock(frame);
      if (this.file.load32(at) === whole) {
        const read = this.#copy(frame, at, whole, to);
        if (read !== null) {
          if (this.#last !== 0) this.skipped += sequence32Of(frame - this.#last) - 1;
          this.#last = frame;
          return read;
        }
      }
      this.overtaken++;
    }
    return null;
  }

  /** Marks the newest frame as read. @throws {SharedMemoryError} `truncated` */
  skip(): void {
    this.#last = this.published;
  }

  close(): void {
    this.file.close();
  }

  [Symbol.dispose](): void {
    this.close();
  }

  /** `null` if the slot was written to meanwhile. */
  #copy(frame: number, at: number, whole: number, to: FrameRoom): CloudFrame | null {
    const { file } = this;
    let header: FrameHeader;
    try {
      file.copyOut(at, this.#slotHeader);
      header = parseFrameHeader(this.#slotHeader, this.header, file.path, at);
      this.#copyPoints(header, at, to);
    } catch (error) {
      // Impossible values may belong to a half-written newer frame.
      file.fence();
      if (file.load32(at) !== whole) return null;
      this.#last = frame;
      throw error;
    }
    file.fence();
    if (file.load32(at) !== whole) return null;
    return { frame, form: formOf(header), points: header.width * header.height, ...header };
  }

  #copyPoints(header: FrameHeader, at: number, to: FrameRoom): void {
    const { file } = this;
    const { format } = this.header;
    const { width, height, depthUnit } = header;
    const pixels = width * height;
    const images = formOf(header) === 'images';
    const room = images ? Math.min(to.depth.length, to.colour.length) : Math.floor(to.points.length / 4);
    if (pixels > room) {
      const detail = `${width} × ${height} points, room for ${room}`;
      throw new SharedMemoryError('too-large', file.path, at + 16, detail);
    }
    const depth = at + SLOT_HEADER_BYTES;
    if (images) {
      const colour = format === 'points' ? depth : depth + colourOffset(format, pixels);
      file.images(format, { depth, colour, pixels, unit: depthUnit }, to);
    } else {
      file.copyOut(depth, to.points.subarray(0, pixels * 4));
    }
  }
}

/** Points on a camera's grid are its pixels: depth and colour contain everything. */
function formOf({ lens }: FrameHeader): 'points' | 'images' {
  return lens === null ? 'points' : 'images';
}
