/**
 * LZF decompression (LibLZF's format), as used in PCD files with `DATA binary_compressed`. A stream of control bytes:
 * below 32, a run of `control + 1` literals follows; else a copy of `(control >> 5) + 2` bytes (for 7, the next byte is
 * added) from `((control & 31) << 8 | next byte) + 1` bytes back in the output.
 */

export type LzfErrorCode =
  | 'truncated' // the input ends within a run
  | 'overflow' // more output than announced
  | 'underflow' // less output than announced
  | 'bad-reference'; // a copy from before the beginning

export class LzfError extends Error {
  override readonly name = 'LzfError';
  readonly code: LzfErrorCode;
  /** Byte of the input at which the error was found. */
  readonly offset: number;

  constructor(code: LzfErrorCode, offset: number) {
    super(`LZF data, byte ${offset}: ${code}`);
    this.code = code;
    this.offset = offset;
  }
}

/**
 * @param outputBytes exact length of the output
 * @throws {LzfError} for anything else
 */
export function decompressLzf(input: Uint8Array, outputBytes: number): Uint8Array {
  const output = new Uint8Array(outputBytes);
  let from = 0;
  let to = 0;
  while (from < input.length) {
    const begin = from;
    const control = input[from++] as number;
    if (control < 32) {
      const length = control + 1;
      if (from + length > input.length) throw new LzfError('truncated', begin);
      if (to + length > outputBytes) throw new LzfError('overflow', begin);
      for (let i = 0; i < length; i++) output[to++] = input[from++] as number;
      continue;
    }
    let length = control >> 5;
    if (length === 7) {
      if (from >= input.length) throw new LzfError('truncated', begin);
      length += input[from++] as number;
    }
    length += 2;
    if (from >= input.length) throw new LzfError('truncated', begin);
    let reference = to - (((control & 31) << 8) | (input[from++] as number)) - 1;
    if (reference < 0) throw new LzfError('bad-reference', begin);
    if (to + length > outputBytes) throw new LzfError('overflow', begin);
    // Byte by byte, because the copy may overlap its own output.
    for (let i = 0; i < length; i++) output[to++] = output[reference++] as number;
  }
  if (to !== outputBytes) throw new LzfError('underflow', input.length);
  return output;
}
