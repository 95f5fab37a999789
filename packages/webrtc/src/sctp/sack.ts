/** Acknowledgements (SACK, RFC 9260 §3.3.4): ours as bytes, and what of a peer's is worth reading. */
import { Buffer } from 'node:buffer';
import { SACK_CHUNK } from './layout.ts';

/** A SACK without blocks (RFC 9260 §3.3.4). */
const CHUNK_BYTES = 16;
/** With {@link MAX_REPEATED}, what fits into a packet of werift's MTU (1,191 bytes). */
export const MAX_BLOCKS = 256;
export const MAX_REPEATED = 16;

export type GapBlock = [start: number, end: number];

export interface Sack {
  /** The last number that was received in order. */
  last: number;
  /** What the receiver has room for, bytes. */
  room: number;
  /** What has arrived beyond `last`, relative to it. */
  blocks: readonly Readonly<GapBlock>[];
  /** Numbers that were received again. */
  repeated: readonly number[];
}

/** The chunk, with its header. */
export function writeSack({ last, room, blocks, repeated }: Sack): Buffer {
  const bytes = Buffer.alloc(CHUNK_BYTES + 4 * (blocks.length + repeated.length));
  bytes.writeUInt8(SACK_CHUNK, 0);
  bytes.writeUInt16BE(bytes.length, 2);
  bytes.writeUInt32BE(last >>> 0, 4);
  bytes.writeUInt32BE(Math.min(Math.max(0, room), 2 ** 32 - 1), 8);
  bytes.writeUInt16BE(blocks.length, 12);
  bytes.writeUInt16BE(repeated.length, 14);
  let at = CHUNK_BYTES;
  for (const [start, end] of blocks) {
    bytes.writeUInt16BE(start, at);
    bytes.writeUInt16BE(end, at + 2);
    at += 4;
  }
  for (const tsn of repeated) at = bytes.writeUInt32BE(tsn >>> 0, at);
  return bytes;
}

/**
 * Cuts off what a peer acknowledges although it was never sent: werift makes a set of all numbers in the blocks, and a
 * block of four bytes can name 65,535.
 *
 * @param blocks in order and disjoint; changed in place
 * @param most the last number sent, relative to that which the blocks are relative to
 */
export function clipBlocks(blocks: GapBlock[], most: number): void {
  const beyond = blocks.findIndex(([start]) => start > most);
  if (beyond >= 0) blocks.length = beyond;
  const last = blocks.at(-1);
  if (last !== undefined && last[1] > most) last[1] = most;
}
