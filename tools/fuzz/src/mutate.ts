import type { Random } from '@farpoint/network-sim/random';

/** Values at which lengths and counters go wrong. */
const EDGES = [
  0,
  1,
  2,
  3,
  4,
  7,
  8,
  12,
  16,
  127,
  128,
  255,
  256,
  32_767,
  32_768,
  65_535,
  2 ** 31 - 1,
  2 ** 31,
  2 ** 32 - 1,
];
/** Pieces of JSON that change what a text means. */
const TOKENS = [
  'null',
  '1e999',
  '-0',
  '[]',
  '{}',
  '"',
  '\\u0000',
  '\\ud800',
  '"__proto__":',
  ',',
  '}',
  '[[',
  '0.1',
  '-1',
  'true',
].map((token) => Buffer.from(token));
const MOST_CHANGES = 5;

type Change = (bytes: Buffer, draw: (limit: number) => number, others: readonly Uint8Array[]) => Buffer;

const changes: readonly Change[] = [
  function flipBit(bytes, draw) {
    const at = draw(bytes.length);
    bytes[at] = (bytes[at] ?? 0) ^ (1 << draw(8));
    return bytes;
  },
  function setByte(bytes, draw) {
    bytes[draw(bytes.length)] = draw(256);
    return bytes;
  },
  function setEdge(bytes, draw) {
    const size = [1, 2, 4][draw(3)] as number;
    const edge = (EDGES[draw(EDGES.length)] as number) % 2 ** (8 * size);
    const at = draw(Math.max(1, bytes.length - size + 1));
    if (bytes.length < size) return bytes;
    if (draw(2) === 0) bytes.writeUIntBE(edge, at, size);
    else bytes.writeUIntLE(edge, at, size);
    return bytes;
  },
  function addToByte(bytes, draw) {
    const at = draw(bytes.length);
    bytes[at] = (bytes[at] ?? 0) + (draw(2) === 0 ? 1 : 255);
    return bytes;
  },
  function cutOff(bytes, draw) {
    return bytes.subarray(0, draw(bytes.length + 1));
  },
  function remove(bytes, draw) {
    const at = draw(bytes.length);
    return Buffer.concat([bytes.subarray(0, at), bytes.subarray(at + 1 + draw(16))]);
  },
  function repeat(bytes, draw) {
    const at = draw(bytes.length);
    const part = bytes.subarray(at, at + 1 + draw(32));
    return Buffer.concat([
      bytes.subarray(0, at),
      ...new Array<Buffer>(1 + draw(4)).fill(part),
      bytes.subarray(at),
    ]);
  },
  function insertToken(bytes, draw) {
    const at = draw(bytes.length + 1);
    return Buffer.concat([bytes.subarray(0, at), TOKENS[draw(TOKENS.length)] as Buffer, bytes.subarray(at)]);
  },
  function append(bytes, draw) {
    return Buffer.concat([bytes, Buffer.alloc(1 + draw(64), draw(256))]);
  },
  function splice(bytes, draw, others) {
    const other = others[draw(others.length)] ?? bytes;
    return Buffer.concat([bytes.subarray(0, draw(bytes.length + 1)), other.subarray(draw(other.length + 1))]);
  },
];

/**
 * A changed copy of one of the inputs: one to five changes of bits, bytes, lengths, ends and order.
 *
 * @param inputs not empty
 * @param maxBytes longer results are cut off
 */
export function mutate(inputs: readonly Uint8Array[], random: Random, maxBytes: number): Uint8Array {
  const draw = (limit: number) => Math.floor(random.next() * limit);
  let bytes: Buffer = Buffer.from(inputs[draw(inputs.length)] as Uint8Array);
  for (let left = 1 + draw(MOST_CHANGES); left > 0; left--) {
    const change = changes[draw(changes.length)] as Change;
    bytes = bytes.length === 0 ? Buffer.alloc(1 + draw(8), draw(256)) : change(bytes, draw, inputs);
  }
  // Its own memory: readers may look at what is around a view.
  return Uint8Array.from(bytes.subarray(0, maxBytes));
}
