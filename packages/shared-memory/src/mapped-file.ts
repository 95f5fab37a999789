import { type Addon, type ByteView, loadAddon, type MappingHandle } from './addon.ts';
import { FileInUseError, SharedMemoryError, type SharedMemoryErrorCode } from './errors.ts';
import { lockHolder } from './lock-holder.ts';

/** Whose files are used besides this user's own and root's: those of the user with this id, or everybody's. */
export type TrustedOwner = number | 'any';

export interface MapOptions {
  /** Required size of the file; any size if absent. */
  bytes?: number;
  writable?: boolean;
  /** Creates the file if it is missing, with `bytes` zeros. An existing file of another size is resized to `bytes`. */
  create?: boolean;
  /** With `create`: the file must not exist yet. */
  exclusive?: boolean;
  /** Permissions of a created file; never any for others than owner and group. Default 0600. */
  mode?: number;
  /** Default: nobody's. */
  owner?: TrustedOwner | undefined;
}

const IMAGE_KINDS = ['points', 'depth16', 'depth32'] as const;

/** A file in shared memory, mapped. Every access is safe, whatever another process does to the file meanwhile. */
export class MappedFile implements Disposable {
  readonly path: string;
  readonly bytes: number;
  readonly handle: MappingHandle;
  readonly #addon: Addon;

  private constructor(addon: Addon, path: string, handle: MappingHandle) {
    this.#addon = addon;
    this.path = path;
    this.handle = handle;
    this.bytes = addon.size(handle);
  }

  /** @throws {SharedMemoryError} */
  static open(path: string, options: MapOptions = {}): MappedFile {
    const { bytes = 0, writable = false, create = false, exclusive = false, mode = 0o600 } = options;
    // Root's files are used in any case.
    const { owner = 0 } = options;
    const addon = loadAddon();
    try {
      return new MappedFile(
        addon,
        path,
        addon.open(
          path,
          writable || create,
          create,
          exclusive,
          create,
          bytes,
          mode,
          owner === 'any' ? 0 : owner,
          owner === 'any',
        ),
      );
    } catch (error) {
      throw translated(error, path, bytes);
    }
  }

  /** False once the file was removed, replaced or resized: open it again. */
  get current(): boolean {
    return this.#do(() => this.#addon.current(this.handle));
  }

  /** Locks the file for as long as it is mapped; false if another process holds the lock. */
  lock(): boolean {
    return this.#addon.lock(this.handle);
  }

  /**
   * Locks the file as {@link lock} does.
   *
   * @param remedy what to do if another process holds the lock, for people; begins with a verb
   * @throws {FileInUseError}
   */
  claim(remedy: string): void {
    if (!this.lock()) throw new FileInUseError(this.path, lockHolder(this.path), remedy);
  }

  /**
   * Loads a byte with acquire semantics: it sees everything stored before that byte.
   *
   * @throws {SharedMemoryError} as every access: `truncated`
   */
  load8(offset: number): number {
    return this.#do(() => this.#addon.load8(this.handle, offset));
  }

  /** Loads an aligned word with acquire semantics. */
  load32(offset: number): number {
    return this.#do(() => this.#addon.load32(this.handle, offset));
  }

  /** Stores a byte with release semantics: others see it after everything stored before. */
  store8(offset: number, value: number): void {
    this.#do(() => this.#addon.store8(this.handle, offset, value));
  }

  store32(offset: number, value: number): void {
    this.#do(() => this.#addon.store32(this.handle, offset, value));
  }

  /** A full memory fence: no access moves past it in either direction. */
  fence(): void {
    this.#addon.fence();
  }

  copyOut(offset: number, to: ByteView): void {
    this.#do(() => this.#addon.copyOut(this.handle, offset, to));
  }

  copyIn(offset: number, from: ByteView): void {
    this.#do(() => this.#addon.copyIn(this.handle, offset, from));
  }

  /** Wakes those who wait for the word at `offset` to change. */
  wake(offset: number): void {
    this.#addon.wake(this.handle, offset);
  }

  /**
   * Unpacks the reference system's points to points of 16 bytes, in one pass.
   *
   * @param bytes 8 for each point
   * @returns whether every point has the latency test's colour
   */
  unpackPoints64(offset: number, bytes: number, to: ByteView): boolean {
    return this.#do(() => this.#addon.unpackPoints64(this.handle, offset, bytes, to));
  }

  /**
   * Reads depth and colour of each pixel, in one pass.
   *
   * @param kind points of 16 bytes, of which z and colour are used; 16-bit depth in units of `unit` metres; or float32
   * metres
   */
  images(
    kind: 'points' | 'depth16' | 'depth32',
    where: { depth: number; colour: number; pixels: number; unit: number },
    to: { depth: Float32Array; colour: Uint32Array },
  ): void {
    const { depth, colour, pixels, unit } = where;
    const index = IMAGE_KINDS.indexOf(kind);
    this.#do(() => this.#addon.images(this.handle, index, depth, colour, pixels, unit, to.depth, to.colour));
  }

  close(): void {
    this.#addon.close(this.handle);
  }

  [Symbol.dispose](): void {
    this.close();
  }

  #do<T>(access: () => T): T {
    try {
      return access();
    } catch (error) {
      throw translated(error, this.path, this.bytes);
    }
  }
}

const SYSTEM_CODES: Readonly<Record<string, readonly [SharedMemoryErrorCode, string]>> = {
  ENOENT: ['absent', 'there is no such file'],
  ENOTDIR: ['absent', 'there is no such folder'],
  EACCES: ['not-permitted', 'the system does not permit it'],
  EPERM: ['not-permitted', 'the system does not permit it'],
  EROFS: ['not-permitted', 'the file system is read-only'],
  EEXIST: ['in-use', 'it already exists'],
  ELOOP: ['not-a-file', 'a symbolic link is not followed'],
  EISDIR: ['not-a-file', 'it is a folder'],
  FILE: ['not-a-file', 'it is not a regular file'],
  ENOSPC: ['out-of-memory', 'the shared memory is full'],
  ENOMEM: ['out-of-memory', 'out of memory'],
};

/** Translates the addon's error to this package's errors; mistakes of the caller are not translated. */
export function translated(error: unknown, path: string, wantedBytes: number): unknown {
  if (!(error instanceof Error)) return error;
  const { code = '' } = error as NodeJS.ErrnoException;
  const number = Number(error.message);
  const known = SYSTEM_CODES[code];
  if (known !== undefined) return new SharedMemoryError(known[0], path, null, known[1]);
  switch (code) {
    case 'UNSAFE':
      return new SharedMemoryError(
        'unsafe-permissions',
        path,
        null,
        `everybody may write it (mode ${number.toString(8)}): \`chmod o-w\` it`,
      );
    case 'OWNER':
      return new SharedMemoryError(
        'foreign-owner',
        path,
        null,
        `another user (${number}) made it: remove it, or allow that user’s files (--shm-owner ${number})`,
      );
    case 'SIZE':
      return new SharedMemoryError(
        'wrong-size',
        path,
        number,
        wantedBytes === 0 ? 'it is empty' : `it has ${number} bytes, not ${wantedBytes}`,
      );
    case 'FAULT':
      return new SharedMemoryError('truncated', path, number, 'the file was truncated while in use');
    case 'EMFILE':
    case 'EIO':
      return new SharedMemoryError('io', path, null, `the system refuses access (${code})`);
    case 'CLOSED':
      return new Error(`${path}: it was closed`);
    case 'RANGE':
      return Number.isNaN(number) ? error : new RangeError(`${path}: not within the file: ${number}`);
    default:
      return error;
  }
}
