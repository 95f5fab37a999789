/** A plain LZF compressor for tests: finds repeats through a hash of three bytes. */
export function compressLzf(input: Uint8Array): Uint8Array {
  const output: number[] = [];
  const seen = new Map<number, number>();
  let literals: number[] = [];
  const flush = () => {
    if (literals.length > 0) output.push(literals.length - 1, ...literals);
    literals = [];
  };
  for (let at = 0; at < input.length; ) {
    const key = ((input[at] ?? 0) << 16) | ((input[at + 1] ?? 0) << 8) | (input[at + 2] ?? 0);
    const before = at + 2 < input.length ? seen.get(key) : undefined;
    seen.set(key, at);
    const distance = before === undefined ? Number.POSITIVE_INFINITY : at - before - 1;
    let length = 0;
    if (before !== undefined && distance < 8192) {
      while (length < 264 && at + length < input.length && input[before + length] === input[at + length])
        length++;
    }
    if (length < 3) {
      literals.push(input[at] as number);
      if (literals.length === 32) flush();
      at++;
      continue;
    }
    flush();
    const code = length - 2;
    if (code < 7) output.push((code << 5) | (distance >> 8), distance & 0xff);
    else output.push((7 << 5) | (distance >> 8), code - 7, distance & 0xff);
    at += length;
  }
  flush();
  return Uint8Array.from(output);
}
