/** Why shared memory could not be used. */
export type SharedMemoryErrorCode =
  | 'unavailable' // the addon is not built, or this is not Linux
  | 'absent' // no such file
  | 'not-permitted' // the system refuses it
  | 'unsafe-permissions' // anybody may write it
  | 'not-a-file' // a symbolic link, a folder, a device
  | 'wrong-size' // other than the layout says
  | 'truncated' // it became shorter while it was used
  | 'bad-magic' // not this layout's file
  | 'bad-version'
  | 'bad-header' // a header that contradicts itself or the file's size
  | 'bad-length' // a payload length that cannot be
  | 'bad-frame' // a frame's own header is impossible
  | 'too-large' // more points than the reader has room for
  | 'in-use' // another producer is at work
  | 'out-of-memory'
  | 'io';

/** Thrown for every file that is not as it should be; nothing else is thrown for what another process did. */
export class SharedMemoryError extends Error {
  override readonly name = 'SharedMemoryError';
  readonly code: SharedMemoryErrorCode;
  /** The file concerned; empty where it is none. */
  readonly file: string;
  /** Byte at which the fault is, or `null` for the whole. */
  readonly offset: number | null;

  constructor(code: SharedMemoryErrorCode, file: string, offset: number | null, detail: string) {
    const place = offset === null ? file : `${file}, byte ${offset}`;
    super(place === '' ? detail : `${place}: ${detail}`);
    this.code = code;
    this.file = file;
    this.offset = offset;
  }
}
