/** The block of a stop at the robot, specified in docs/shared-memory.md: a stop byte and a counter that must run. */
import { SharedMemoryError } from '../errors.ts';
import { MappedFile, type TrustedOwner } from '../mapped-file.ts';

/** The block’s length, and where its fields are, bytes. */
export const STOP_BYTES = 16;
const MAGIC = 'FARPSTOP';
const COUNTER_OFFSET = 8;
const STOP_OFFSET = 12;
const VERSION_OFFSET = 13;
const VERSION = 1;

export interface StopWord {
  /** Changes as long as the writer lives. */
  counter: number;
  stop: boolean;
}

/** Reads the block. Maps the file read-only. */
export class StopBlock implements Disposable {
  readonly #file: MappedFile;

  private constructor(file: MappedFile) {
    this.#file = file;
  }

  /** @throws {SharedMemoryError} */
  static open(path: string, owner?: TrustedOwner): StopBlock {
    const file = MappedFile.open(path, { bytes: STOP_BYTES, owner });
    try {
      const bytes = new Uint8Array(STOP_BYTES);
      file.copyOut(0, bytes);
      if (String.fromCharCode(...bytes.subarray(0, MAGIC.length)) !== MAGIC)
        throw new SharedMemoryError('bad-magic', path, 0, `does not begin with ${MAGIC}`);
      if (bytes[VERSION_OFFSET] !== VERSION)
        throw new SharedMemoryError('bad-version', path, VERSION_OFFSET, `version ${bytes[VERSION_OFFSET]}`);
      return new StopBlock(file);
    } catch (error) {
      file.close();
      throw error;
    }
  }

  /** False once the file was removed, replaced or resized. */
  get current(): boolean {
    return this.#file.current;
  }

  /** @throws {SharedMemoryError} `truncated` */
  read(): StopWord {
    // The counter first: the stop byte is then at least as new.
    const counter = this.#file.load32(COUNTER_OFFSET);
    return { counter, stop: this.#file.load8(STOP_OFFSET) !== 0 };
  }

  close(): void {
    this.#file.close();
  }

  [Symbol.dispose](): void {
    this.close();
  }
}

/** Writes the block, as the program does that the stop belongs to. */
export class StopBlockWriter implements Disposable {
  readonly #file: MappedFile;
  #counter = 0;

  /** Creates the file; until the first {@link write} it says stop. @throws {SharedMemoryError} */
  constructor(path: string, mode = 0o600) {
    this.#file = MappedFile.open(path, { bytes: STOP_BYTES, create: true, writable: true, mode });
    this.#counter = this.#file.load32(COUNTER_OFFSET);
    this.#file.store8(STOP_OFFSET, 1);
    this.#file.store8(VERSION_OFFSET, VERSION);
    this.#file.copyIn(0, new TextEncoder().encode(MAGIC));
  }

  /** Call it every 100 ms or more often. @throws {SharedMemoryError} `truncated` */
  write(stop: boolean): void {
    this.#file.store8(STOP_OFFSET, stop ? 1 : 0);
    this.#counter = (this.#counter + 1) >>> 0;
    this.#file.store32(COUNTER_OFFSET, this.#counter);
  }

  close(): void {
    this.#file.close();
  }

  [Symbol.dispose](): void {
    this.close();
  }
}
