import { type FileHandle, open } from 'node:fs/promises';
import { detailOf, RecordingError } from './errors.ts';

/** Maximum size of a record: a cloud of 4 million points with everything that a LiDAR reports takes half of it. */
export const MAX_RECORD_BYTES = 512 * 1024 * 1024;

/** A file that is read in pieces, at any position. */
export class FileBytes {
  readonly path: string;
  readonly size: number;
  /** Where the last piece began: close to the fault if an error occurs. */
  lastOffset = 0;
  readonly #handle: FileHandle;

  private constructor(path: string, size: number, handle: FileHandle) {
    this.path = path;
    this.size = size;
    this.#handle = handle;
  }

  /** @throws {RecordingError} `unreadable` */
  static async open(path: string): Promise<FileBytes> {
    try {
      const handle = await open(path, 'r');
      const stat = await handle.stat();
      if (!stat.isFile()) {
        await handle.close();
        throw new Error('not a file');
      }
      return new FileBytes(path, stat.size, handle);
    } catch (error) {
      throw new RecordingError('unreadable', detailOf(error), { file: path, cause: error });
    }
  }

  /** @throws {RecordingError} `too-large`, `truncated`, `unreadable` */
  async read(offset: number, length: number): Promise<Uint8Array> {
    const where = { file: this.path, offset };
    if (length > MAX_RECORD_BYTES)
      throw new RecordingError('too-large', `a record of ${length} bytes`, where);
    if (length < 0 || offset < 0 || offset + length > this.size) {
      throw new RecordingError('truncated', `${length} bytes expected, the file has ${this.size}`, where);
    }
    this.lastOffset = offset;
    const bytes = new Uint8Array(length);
    for (let at = 0; at < length; ) {
      let bytesRead: number;
      try {
        ({ bytesRead } = await this.#handle.read(bytes, at, length - at, offset + at));
      } catch (error) {
        throw new RecordingError('unreadable', detailOf(error), { ...where, cause: error });
      }
      if (bytesRead === 0) throw new RecordingError('truncated', 'the file was truncated', where);
      at += bytesRead;
    }
    return bytes;
  }

  close(): Promise<void> {
    return this.#handle.close();
  }
}
