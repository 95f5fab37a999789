/** Why bytes from outside were refused. */
export type ProtocolErrorCode =
  | 'too-large' // more bytes than this message may have
  | 'too-short' // fewer bytes than the fixed part needs
  | 'not-utf8'
  | 'not-json'
  | 'invalid'; // correct encoding, wrong content: `path` says where

/** Thrown by every decoder of this package for input that it refuses. Bad input causes no other exception. */
export class ProtocolError extends Error {
  override readonly name = 'ProtocolError';
  readonly code: ProtocolErrorCode;
  /** What was being decoded, for example `operator command`. */
  readonly what: string;
  /** Where in it the fault is, for example `twist.linear.x`; empty for the whole message. */
  readonly path: string;

  constructor(code: ProtocolErrorCode, what: string, path: string, detail: string) {
    super(path === '' ? `${what}: ${detail}` : `${what}: ${path}: ${detail}`);
    this.code = code;
    this.what = what;
    this.path = path;
  }
}
