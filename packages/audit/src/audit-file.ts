/** The file of an audit log: opened for appending, with its owner's permissions, synchronised after each write. */
import { constants } from 'node:fs';
import { type FileHandle, open, readdir, rename, stat } from 'node:fs/promises';
import { basename, dirname, join } from 'node:path';
import { CHAIN_START, type ChainEnd, MAX_LINE_BYTES } from './audit-entry.ts';
import type { FragmentDescription } from './fragment.ts';
import { type LogTail, readTail } from './log-tail.ts';

/** How much of a file's end is searched for its last entry, bytes. */
const TAIL_BYTES = 16 * MAX_LINE_BYTES;
const { O_APPEND, O_CREAT, O_NOFOLLOW, O_NONBLOCK, O_RDWR } = constants;

/** What was found when the file was opened. */
export interface OpenedLog {
  readonly end: ChainEnd;
  readonly torn: FragmentDescription | null;
  /** Where a file went that was no audit log, or too damaged to be continued; null if there was none. */
  readonly setAside: { readonly file: string; readonly bytes: number } | null;
}

/** The file at the path cannot be an audit log. */
export class AuditFileError extends Error {
  override readonly name = 'AuditFileError';
}

export class AuditFile {
  readonly path: string;
  readonly #maxBytes: number;
  #handle: FileHandle;
  /** What the file should have, if nobody else writes to it; unknown (NaN) after a failed write. */
  #bytes: number;
  /** Whether a newline must come before the next entry. */
  #inLine: boolean;

  private constructor(path: string, maxBytes: number, handle: FileHandle, bytes: number, inLine: boolean) {
    this.path = path;
    this.#maxBytes = maxBytes;
    this.#handle = handle;
    this.#bytes = bytes;
    this.#inLine = inLine;
  }

  /**
   * Opens the log, or creates it. A chain goes on where the file, or else the last rotated file, ends.
   *
   * @param maxBytes size that makes the file be renamed, and a new one begin
   * @throws {AuditFileError} if it is not a regular file; a system error if it cannot be opened
   */
  static async open(path: string, maxBytes: number): Promise<{ file: AuditFile; found: OpenedLog }> {
    let handle = await openLog(path);
    try {
      const { size } = await handle.stat();
      const tail = size === 0 ? null : await tailOf(handle, size);
      if (size === 0 || tail !== null) {
        const file = new AuditFile(path, maxBytes, handle, size, tail !== null && !tail.endsLine);
        const end = tail?.end ?? (await endOfRotated(path));
        return { file, found: { end, torn: tail?.torn ?? null, setAside: null } };
      }
      const aside = await freeName(`${path}.damaged`);
      await rename(path, aside);
      await handle.close();
      handle = await openLog(path);
      const file = new AuditFile(path, maxBytes, handle, 0, false);
      const end = await endOfRotated(path);
      return { file, found: { end, torn: null, setAside: { file: aside, bytes: size } } };
    } catch (error) {
      await handle.close();
      throw error;
    }
  }

  /** Whether the path still leads to this file, and nobody else has written to it. */
  async isCurrent(): Promise<boolean> {
    const [ours, there] = await Promise.all([
      this.#handle.stat(),
      stat(this.path).catch((error: NodeJS.ErrnoException) => {
        if (error.code === 'ENOENT') return null;
        throw error;
      }),
    ]);
    return there !== null && there.ino === ours.ino && there.dev === ours.dev && ours.size === this.#bytes;
  }

  /** Whether a new file should begin before these bytes. */
  isFull(bytes: number): boolean {
    return this.#bytes > 0 && this.#bytes + bytes > this.#maxBytes;
  }

  /** Writes all of it, and waits until the disk has it. @throws a system error; some of it may have been written */
  async append(text: string): Promise<void> {
    const bytes = Buffer.from(this.#inLine ? `\n${text}` : text);
    const before = this.#bytes;
    this.#bytes = Number.NaN;
    try {
      for (let at = 0; at < bytes.byteLength; ) at += (await this.#handle.write(bytes, at)).bytesWritten;
      await this.#handle.datasync();
    } catch (error) {
      // Leaves nothing half-written, so that a full disk does not fill with attempts. Fails for append-only files.
      await this.#handle.truncate(before).then(
        () => {
          this.#bytes = before;
        },
        () => undefined,
      );
      throw error;
    }
    this.#bytes = before + bytes.byteLength;
    this.#inLine = false;
  }

  /** Renames the file to `PATH.NUMBER`, the number being that of its last entry, and begins a new one. */
  async rotate({ sequence }: ChainEnd): Promise<void> {
    const name = await freeName(`${this.path}.${String(Math.max(0, sequence - 1)).padStart(12, '0')}`);
    await rename(this.path, name);
    const handle = await openLog(this.path);
    await this.#handle.close();
    this.#handle = handle;
    this.#bytes = 0;
  }

  async close(): Promise<void> {
    await this.#handle.close();
  }
}

/** @throws {AuditFileError} */
async function openLog(path: string): Promise<FileHandle> {
  const handle = await open(path, O_RDWR | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK, 0o600);
  try {
    const status = await handle.stat();
    if (!status.isFile()) throw new AuditFileError(`${path} is not a regular file`);
    if ((status.mode & 0o077) !== 0)
      await handle.chmod(0o600).catch(() => {
        throw new AuditFileError(`${path} is open to others, which only its owner can change (chmod 600)`);
      });
    await syncFolder(dirname(path));
    return handle;
  } catch (error) {
    await handle.close();
    throw error;
  }
}

/** Makes the file's name survive a crash of the machine. */
async function syncFolder(folder: string): Promise<void> {
  const handle = await open(folder, constants.O_RDONLY);
  try {
    await handle.sync();
  } finally {
    await handle.close();
  }
}

async function tailOf(handle: FileHandle, size: number): Promise<LogTail | null> {
  const bytes = Buffer.alloc(Math.min(size, TAIL_BYTES));
  const { bytesRead } = await handle.read(bytes, 0, bytes.byteLength, size - bytes.byteLength);
  return readTail(bytes.subarray(0, bytesRead));
}

/** The chain's end in the newest of the rotated files; its start if there are none. */
async function endOfRotated(path: string): Promise<ChainEnd> {
  const prefix = `${basename(path)}.`;
  const names = (await readdir(dirname(path)))
    .filter((name) => name.startsWith(prefix) && /^\d{12}$/.test(name.slice(prefix.length)))
    .sort();
  const newest = names.at(-1);
  if (newest === undefined) return CHAIN_START;
  const handle = await open(join(dirname(path), newest), constants.O_RDONLY | O_NOFOLLOW);
  try {
    const tail = await tailOf(handle, (await handle.stat()).size);
    return tail?.end ?? CHAIN_START;
  } finally {
    await handle.close();
  }
}

/** A name that nothing has yet: this one, or with a number after it. */
async function freeName(name: string): Promise<string> {
  for (let number = 1; ; number++) {
    const candidate = number === 1 ? name : `${name}-${number}`;
    const taken = await stat(candidate).then(
      () => true,
      () => false,
    );
    if (!taken) return candidate;
  }
}
