import { renameSync, unlinkSync } from 'node:fs';
import { nextSequence32 } from '@farpoint/protocol';
import type { ByteView } from '../addon.ts';
import { SharedMemoryError } from '../errors.ts';
import { MappedFile } from '../mapped-file.ts';
import {
  type CloudFormat,
  type CloudHeader,
  cloudFile,
  colourOffset,
  completeLock,
  type FrameHeader,
  fileBytes,
  HEADER_BYTES,
  makeHeader,
  PUBLISHED_OFFSET,
  parseFrameHeader,
  SLOT_HEADER_BYTES,
  slotOffset,
  writeFrameHeader,
  writeHeader,
  writingLock,
} from './layout.ts';

export interface CloudProducerOptions {
  folder?: string | undefined;
  format: CloudFormat;
  maxPoints: number;
  framesPerSecond?: number;
  slots?: number;
  /** 0600 (default), or 0660 for a group. */
  mode?: number;
}

export type FrameContent =
  | {
      /** 16 bytes per point. */
      points: ByteView;
    }
  | { depth: Uint8Array | Uint16Array | Float32Array; colours: Uint8Array };

/**
 * The producer in TypeScript. A new file is created under a temporary name and then renamed, so that no reader ever
 * sees half a header. Readers of an earlier file notice this and open the new one.
 */
export class CloudProducer implements Disposable {
  readonly header: CloudHeader;
  readonly #file: MappedFile;
  readonly #slotHeader = new Uint8Array(SLOT_HEADER_BYTES);
  #frame = 0;

  /** @throws {SharedMemoryError} `in-use` while another producer is running */
  constructor(options: CloudProducerOptions) {
    const { folder, format, maxPoints, framesPerSecond = 0, slots = 4, mode = 0o600 } = options;
    this.header = makeHeader({ format, maxPoints, framesPerSecond, slots, pid: process.pid });
    const path = cloudFile(folder);
    const former = openFormer(path);
    try {
      if (former !== null && !former.lock()) throw inUse(path);
      this.#file = makeFile(path, this.header, mode);
    } finally {
      former?.close();
    }
  }

  /** Writes one frame and wakes its waiting readers. @throws {SharedMemoryError} `bad-frame`, `in-use`, `truncated` */
  publish(content: FrameContent, header: Omit<FrameHeader, 'depthUnit'> & { depthUnit?: number }): number {
    const file = this.#file;
    if (!file.current) throw inUse(file.path);
    const frame = nextSequence32(this.#frame);
    const at = slotOffset(this.header, frame);
    writeFrameHeader(this.#slotHeader, frame, { depthUnit: 0, ...header });
    const { width, height } = parseFrameHeader(this.#slotHeader, this.header, file.path, at);
    checkContent(content, this.header.format, width * height);
    file.store32(at, writingLock(frame));
    // No byte of the frame may become visible before the closed lock does.
    file.fence();
    file.copyIn(at + 4, this.#slotHeader.subarray(4));
    const payload = at + SLOT_HEADER_BYTES;
    if ('points' in content) {
      file.copyIn(payload, content.points);
    } else {
      const { buffer, byteOffset, byteLength } = content.depth;
      file.copyIn(payload, new Uint8Array(buffer, byteOffset, byteLength));
      file.copyIn(payload + colourOffset(this.header.format, width * height), content.colours);
    }
    file.store32(at, completeLock(frame));
    file.store32(PUBLISHED_OFFSET, frame);
    file.wake(PUBLISHED_OFFSET);
    this.#frame = frame;
    return frame;
  }

  close(): void {
    this.#file.close();
  }

  [Symbol.dispose](): void {
    this.close();
  }
}

/** A payload that is too long would overwrite the next slot. */
function checkContent(content: FrameContent, format: CloudFormat, points: number): void {
  const right =
    'points' in content
      ? format === 'points' && content.points.byteLength === points * 16
      : format !== 'points' &&
        content.depth.byteLength === points * (format === 'depth16' ? 2 : 4) &&
        content.colours.byteLength === points * 4;
  if (!right) throw new RangeError(`this is not a ${format} frame of ${points} points`);
}

/** Opens an existing file, whatever it is; its lock shows whether its producer is running. */
function openFormer(path: string): MappedFile | null {
  try {
    return MappedFile.open(path);
  } catch {
    return null;
  }
}

function makeFile(path: string, header: CloudHeader, mode: number): MappedFile {
  const unfinished = `${path}.new`;
  const create = { bytes: fileBytes(header), create: true, exclusive: true, mode };
  let file: MappedFile;
  try {
    file = MappedFile.open(unfinished, create);
  } catch (error) {
    if (!(error instanceof SharedMemoryError && error.code === 'in-use')) throw error;
    // Left behind by a producer that was killed while it started.
    unlinkSync(unfinished);
    file = MappedFile.open(unfinished, create);
  }
  try {
    const bytes = new Uint8Array(HEADER_BYTES);
    writeHeader(bytes, header);
    file.copyIn(0, bytes);
    if (!file.lock()) throw inUse(path);
    renameSync(unfinished, path);
    return file;
  } catch (error) {
    file.close();
    throw error;
  }
}

function inUse(path: string): SharedMemoryError {
  return new SharedMemoryError('in-use', path, null, 'another producer is writing it');
}
