/** Why shared memory could not be used. */
export type SharedMemoryErrorCode =
  | 'unavailable' // the addon is not built, or this is not Linux
  | 'absent' // no such file
  | 'not-permitted' // the system refuses access
  | 'unsafe-permissions' // everybody may write to it
  | 'foreign-owner' // another user made it
  | 'not-a-file' // a symbolic link, a folder, a device
  | 'wrong-size' // not the size that the layout requires
  | 'truncated' // it became shorter while it was in use
  | 'bad-magic' // not a file with this layout
  | 'bad-version'
  | 'bad-header' // a header that contradicts itself or the file's size
  | 'bad-length' // an impossible payload length
  | 'bad-frame' // an impossible header of a frame
  | 'too-large' // more points than the reader has room for
  | 'in-use' // another program writes it
  | 'out-of-memory'
  | 'io';

/** Thrown for every invalid file. Nothing that another process does causes any other exception. */
export class SharedMemoryError extends Error {
  override readonly name = 'SharedMemoryError';
  readonly code: SharedMemoryErrorCode;
  /** The file concerned; empty if there is none. */
  readonly file: string;
  /** Byte of the fault, or `null` for the whole file. */
  readonly offset: number | null;

  constructor(code: SharedMemoryErrorCode, file: string, offset: number | null, detail: string) {
    const place = offset === null ? file : `${file}, byte ${offset}`;
    super(place === '' ? detail : `${place}: ${detail}`);
    this.code = code;
    this.file = file;
    this.offset = offset;
  }
}

/** Another process holds the lock of a file that only one may write. */
export class FileInUseError extends SharedMemoryError {
  /** The process, if the system tells it. */
  readonly holder: number | null;
  /** What is wrong, without the remedy. */
  readonly fault: string;
  /** For people; begins with a verb. */
  readonly remedy: string;

  constructor(file: string, holder: number | null, remedy: string) {
    const who = holder === null ? 'another program' : `another program (process ${holder})`;
    super('in-use', file, null, `${who} writes it: ${remedy}`);
    this.holder = holder;
    this.fault = `${file}: ${who} writes it`;
    this.remedy = remedy;
  }
}
