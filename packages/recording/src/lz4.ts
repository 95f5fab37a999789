/**
 * Reads LZ4 frames (the lz4 project's frame format 1.6.4). Ignores their checksums, because the recordings have their
 * own. Why this is not a library's: docs/decisions/2026-11-22-own-lz4.md.
 */
import { RecordingError } from './errors.ts';

const MAGIC = 0x184d2204;
const SKIPPABLE = 0x184d2a50;
const SHORTEST_MATCH = 4;
/** Below this length, copying byte by byte is faster than calling a copy function. */
const FEW_BYTES = 24;

/**
 * @param size of the output
 * @throws {RecordingError} `damaged`, with the byte of the input
 */
export function decompressLz4(input: Uint8Array, size: number): Uint8Array {
  const output = new Uint8Array(size);
  const view = new DataView(input.buffer, input.byteOffset, input.byteLength);
  let at = 0;
  let filled = 0;
  const need = (bytes: number) => {
    if (at + bytes > input.length) throw damaged(at, 'it ends too early');
  };
  while (at < input.length) {
    need(4);
    const magic = view.getUint32(at, true);
    at += 4;
    if (magic >>> 4 === SKIPPABLE >>> 4) {
      need(4);
      at += 4 + view.getUint32(at, true);
      continue;
    }
    if (magic !== MAGIC) throw damaged(at - 4, 'no LZ4 frame');
    need(3);
    const flags = input[at] as number;
    if (flags >> 6 !== 1) throw damaged(at, 'an unknown version');
    if ((flags & 1) !== 0) throw damaged(at, 'it needs a dictionary');
    at += 2 + ((flags & 8) === 0 ? 0 : 8) + 1;
    for (;;) {
      need(4);
      const head = view.getUint32(at, true);
      at += 4;
      if (head === 0) break;
      const bytes = head & 0x7fff_ffff;
      need(bytes);
      if (head >>> 31 === 0) {
        filled = decodeBlock(input, at, at + bytes, output, filled);
      } else {
        if (filled + bytes > size) throw damaged(at, `more than ${size} bytes`);
        output.set(input.subarray(at, at + bytes), filled);
        filled += bytes;
      }
      at += bytes + ((flags & 16) === 0 ? 0 : 4);
    }
    at += (flags & 4) === 0 ? 0 : 4;
  }
  return output.subarray(0, filled);
}

/** Decodes one block; matches may refer to output before it. @returns how far the output is filled */
function decodeBlock(
  input: Uint8Array,
  from: number,
  end: number,
  output: Uint8Array,
  start: number,
): number {
  let at = from;
  let to = start;
  while (at < end) {
    const token = input[at++] as number;
    let literals = token >> 4;
    if (literals === 15) {
      let more: number;
      do {
        if (at >= end) throw damaged(at, 'a length has no end');
        more = input[at++] as number;
        literals += more;
      } while (more === 255);
    }
    if (at + literals > end) throw damaged(at, 'literals beyond their block');
    if (to + literals > output.length) throw damaged(at, `more than ${output.length} bytes`);
    if (literals > FEW_BYTES) {
      output.set(input.subarray(at, at + literals), to);
      at += literals;
      to += literals;
    } else {
      for (let i = 0; i < literals; i++) output[to++] = input[at++] as number;
    }
    // The last sequence has only literals.
    if (at === end) return to;
    if (at + 2 > end) throw damaged(at, 'an offset is cut short');
    const offset = (input[at] as number) | ((input[at + 1] as number) << 8);
    at += 2;
    let match = token & 15;
    if (match === 15) {
      let more: number;
      do {
        if (at >= end) throw damaged(at, 'a length has no end');
        more = input[at++] as number;
        match += more;
      } while (more === 255);
    }
    match += SHORTEST_MATCH;
    if (offset === 0 || offset > to) throw damaged(at, 'a match from before the beginning');
    if (to + match > output.length) throw damaged(at, `more than ${output.length} bytes`);
    if (match > FEW_BYTES && offset >= match) {
      output.copyWithin(to, to - offset, to - offset + match);
      to += match;
    } else {
      // It may overlap itself: copying byte by byte repeats it.
      for (let i = 0; i < match; i++, to++) output[to] = output[to - offset] as number;
    }
  }
  return to;
}

function damaged(at: number, detail: string): RecordingError {
  return new RecordingError('damaged', `LZ4 data, byte ${at} of them: ${detail}`);
}
