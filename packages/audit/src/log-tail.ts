import { type ChainEnd, readEntry, sha256 } from './audit-entry.ts';
import type { FragmentDescription } from './fragment.ts';

/** How a log ends. */
export interface LogTail {
  /** Where the chain goes on. */
  readonly end: ChainEnd;
  /** What a program left that ended while it wrote an entry; null if nothing. */
  readonly torn: FragmentDescription | null;
  /** Whether the last byte is a newline. */
  readonly endsLine: boolean;
}

/**
 * Finds the last whole entry in the last bytes of a log.
 *
 * @param bytes the end of the log, or all of it; longer than the longest line
 * @returns null if there is no entry in them
 */
export function readTail(bytes: Uint8Array): LogTail | null {
  const endsLine = bytes.at(-1) === 0x0a;
  let lineEnd = endsLine ? bytes.byteLength - 1 : bytes.byteLength;
  while (lineEnd > 0) {
    const lineStart = bytes.lastIndexOf(0x0a, lineEnd - 1) + 1;
    const entry = readEntry(bytes.subarray(lineStart, lineEnd));
    if (entry !== null) {
      const rest = bytes.subarray(lineEnd + 1);
      return {
        end: { sequence: entry.sequence + 1, previous: entry.hash },
        torn: rest.byteLength === 0 ? null : { bytes: rest.byteLength, sha256: sha256(rest) },
        endsLine,
      };
    }
    lineEnd = lineStart - 1;
  }
  return null;
}
