/**
 * How much work an SCTP packet makes, so that a peer's budget counts what it costs, and not what it weighs. The unit is
 * a chunk.
 */
import { CHUNK_HEADER_BYTES, COMMON_HEADER_BYTES } from './layout.ts';

/** Bytes of an acknowledgement, of a list of streams or of parameters that cost as much as a chunk. */
const BYTES_PER_UNIT = 64;

/** Chunks whose cost is in what they list: SACK, FORWARD TSN, RE-CONFIG, and those with parameters. */
const LISTS: ReadonlySet<number> = new Set([1, 2, 3, 4, 5, 6, 9, 130, 192]);

/** @param packet that `isSctpPacket` accepts */
export function sctpWork(packet: Buffer): number {
  let work = 0;
  let at = COMMON_HEADER_BYTES;
  while (at + CHUNK_HEADER_BYTES <= packet.length) {
    const length = Math.max(CHUNK_HEADER_BYTES, packet.readUInt16BE(at + 2));
    work += 1 + (LISTS.has(packet.readUInt8(at)) ? Math.floor(length / BYTES_PER_UNIT) : 0);
    at += (length + 3) & ~3;
  }
  return Math.max(1, work);
}
