/** Reads the files of a log and verifies their chain. */
import { closeSync, openSync, readSync } from 'node:fs';
import { readEntry } from './audit-entry.ts';
import {
  type ChainFault,
  ChainVerifier,
  type ChainVerifierOptions,
  type VerifiedChain,
} from './chain-verifier.ts';

/** What is read of a file at once. Chosen: a few thousand entries; more would only take memory. */
const CHUNK_BYTES = 1 << 20;

/**
 * @param paths the files of one log, in any order
 * @throws a system error if a file cannot be read
 */
export function verifyFiles(
  paths: readonly string[],
  options: ChainVerifierOptions = {},
): VerifiedChain | ChainFault {
  const inOrder = paths
    .map((path) => ({ path, begins: firstSequence(path) }))
    .sort((a, b) => a.begins - b.begins);
  const verifier = new ChainVerifier(options);
  const chunk = Buffer.alloc(CHUNK_BYTES);
  for (const { path } of inOrder) {
    verifier.beginFile(path);
    eachChunk(path, chunk, (bytes) => {
      verifier.push(bytes);
      return true;
    });
  }
  return verifier.end();
}

/** Number of the first readable entry near the file's beginning; if there is none, the file comes last. */
function firstSequence(path: string): number {
  let head = Buffer.alloc(0);
  eachChunk(path, Buffer.alloc(CHUNK_BYTES), (bytes) => {
    head = Buffer.concat([head, bytes]);
    return head.byteLength < CHUNK_BYTES;
  });
  for (let from = 0; from < head.byteLength; ) {
    const newline = head.indexOf(0x0a, from);
    const lineEnd = newline === -1 ? head.byteLength : newline;
    const entry = readEntry(head.subarray(from, lineEnd));
    if (entry !== null) return entry.sequence;
    from = lineEnd + 1;
  }
  return Number.MAX_SAFE_INTEGER;
}

/** @param take returns false to stop */
function eachChunk(path: string, chunk: Buffer, take: (bytes: Buffer) => boolean): void {
  const file = openSync(path, 'r');
  try {
    for (;;) {
      const bytes = readSync(file, chunk);
      if (bytes === 0 || !take(chunk.subarray(0, bytes))) return;
    }
  } finally {
    closeSync(file);
  }
}
