/** Files that an option names and that hold text: an empty one is a mistake, never the same as none. */
import { readFileSync, renameSync, writeFileSync } from 'node:fs';
import { fileFault, systemErrorOf } from './system-error.ts';

/** The file holds no text that can be used. The message completes a sentence that begins with the option. */
export class TextFileError extends Error {
  override readonly name = 'TextFileError';
  readonly path: string;
  /** Completes a sentence that begins with the path, such as `is empty`. */
  readonly fault: string;
  /** The system's code for why it could not be read, such as ENOENT; `null` if what it holds is wrong. */
  readonly code: string | null;

  /** @param cause of the system, if it could not be read */
  constructor(path: string, fault: string, cause?: unknown) {
    const unread = `cannot be read: ${fileFault(cause, path) ?? String(cause)}`;
    super(cause === undefined ? `names a file that ${fault}: ${path}` : unread, { cause });
    this.path = path;
    this.fault = fault;
    this.code = systemErrorOf(cause)?.code ?? null;
  }
}

const BYTE_ORDER_MARK = '\uFEFF';

/**
 * Reads text in UTF-8, without the byte order mark that some editors put first.
 *
 * @throws {TextFileError} if it cannot be read, if it is empty or has only blanks, and if it is binary
 */
export function readTextFile(path: string): string {
  let bytes: Uint8Array;
  try {
    bytes = readFileSync(path);
  } catch (error) {
    throw new TextFileError(path, 'cannot be read', error);
  }
  return textOfFile(path, bytes);
}

/** As {@link readTextFile}, of a file that has been read. @throws {TextFileError} */
export function textOfFile(path: string, bytes: Uint8Array): string {
  if ((bytes[0] === 0xff && bytes[1] === 0xfe) || (bytes[0] === 0xfe && bytes[1] === 0xff))
    throw new TextFileError(path, 'is in UTF-16, not UTF-8');
  const text = withoutMark(new TextDecoder('utf-8', { ignoreBOM: true }).decode(bytes));
  if (text.trim() === '') throw new TextFileError(path, 'is empty');
  if (text.includes('\0')) throw new TextFileError(path, 'is not text');
  return text;
}

/** The text without a byte order mark before it. */
export function withoutMark(text: string): string {
  return text.startsWith(BYTE_ORDER_MARK) ? text.slice(1) : text;
}

/**
 * Replaces a file at once: a reader finds either the old text or the new one, also after a loss of power.
 *
 * @param mode permissions of the new file
 * @throws {Error} of the system
 */
export function replaceFile(path: string, text: string, mode: number): void {
  const draft = `${path}.new`;
  writeFileSync(draft, text, { mode, flush: true });
  renameSync(draft, path);
}
