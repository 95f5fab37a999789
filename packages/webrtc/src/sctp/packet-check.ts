/**
 * Checks that an SCTP packet is framed according to RFC 9260 §3. werift's parser trusts every length in the packet: a
 * chunk or parameter of length 0 would make it loop for ever, an overlapping list of gaps would keep it busy for
 * seconds, and so would the answer to a heartbeat of thousands of parameters, which it puts together one by one.
 */
import { CHUNK_HEADER_BYTES, COMMON_HEADER_BYTES, SACK_CHUNK } from './layout.ts';

/** Ours are at most 1,191 bytes, and no peer's path takes much more (RFC 8831 §5). */
const MAX_PACKET_BYTES = 2048;
/** Type and length (§3.2.1). */
const PARAMETER_HEADER_BYTES = 4;

interface ChunkRule {
  min: number;
  parameters?: number;
  /** Fewest and most parameters; by default up to {@link MAX_PARAMETERS}. */
  count?: readonly [fewest: number, most: number];
}

/** Several times what an INIT has. */
const MAX_PARAMETERS = 32;

/** Chunks that werift knows: minimum length of the body, and where in it a list of parameters begins. */
const CHUNKS: ReadonlyMap<number, ChunkRule> = new Map<number, ChunkRule>([
  [0, { min: 13 }], // DATA, which is never empty (§3.3.1)
  [1, { min: 16, parameters: 16 }], // INIT
  [2, { min: 16, parameters: 16 }], // INIT ACK
  [SACK_CHUNK, { min: 12 }],
  [4, { min: 0, parameters: 0, count: [1, 1] }], // HEARTBEAT
  [5, { min: 0, parameters: 0, count: [1, 1] }], // HEARTBEAT ACK
  [6, { min: 0, parameters: 0 }], // ABORT
  [7, { min: 4 }], // SHUTDOWN
  [8, { min: 0 }], // SHUTDOWN ACK
  [9, { min: 0, parameters: 0 }], // ERROR
  [10, { min: 0 }], // COOKIE ECHO
  [11, { min: 0 }], // COOKIE ACK
  [14, { min: 0 }], // SHUTDOWN COMPLETE
  [130, { min: 0, parameters: 0, count: [1, 2] }], // RE-CONFIG (RFC 6525 §3.1)
  [192, { min: 4 }], // FORWARD TSN (RFC 3758)
]);

export function isSctpPacket(packet: Buffer): boolean {
  let at = COMMON_HEADER_BYTES;
  if (packet.length < at + CHUNK_HEADER_BYTES || packet.length > MAX_PACKET_BYTES) return false;
  while (at < packet.length) {
    if (packet.length - at < CHUNK_HEADER_BYTES) return false;
    const length = packet.readUInt16BE(at + 2);
    if (length < CHUNK_HEADER_BYTES || at + length > packet.length) return false;
    const type = packet.readUInt8(at);
    if (!isChunk(type, packet.subarray(at + CHUNK_HEADER_BYTES, at + length))) return false;
    at += padded(length);
  }
  return true;
}

/** @param packet framed properly @returns whether its first chunk is an INIT or INIT ACK */
export function beginsAssociation(packet: Buffer): boolean {
  const type = packet[COMMON_HEADER_BYTES];
  return type === 1 || type === 2;
}

function isChunk(type: number, body: Buffer): boolean {
  const known = CHUNKS.get(type);
  if (known === undefined || body.length < known.min) return false;
  if (known.parameters !== undefined) {
    const [fewest, most] = known.count ?? [0, MAX_PARAMETERS];
    const count = parameterCount(body.subarray(known.parameters));
    return count !== null && count >= fewest && count <= most;
  }
  if (type === SACK_CHUNK) return isSack(body);
  // A list of streams and their numbers, 4 bytes each.
  return type !== 192 || body.length % 4 === 0;
}

/** @returns `null` if a length does not fit */
function parameterCount(list: Buffer): number | null {
  let count = 0;
  let at = 0;
  while (at < list.length) {
    if (list.length - at < PARAMETER_HEADER_BYTES) return null;
    const length = list.readUInt16BE(at + 2);
    if (length < PARAMETER_HEADER_BYTES || at + length > list.length) return null;
    at += padded(length);
    count++;
  }
  return count;
}

/** Gap blocks must be in order and disjoint (RFC 9260 §3.3.4), so that together they cover at most 65,535 numbers. */
function isSack(body: Buffer): boolean {
  const [gaps, duplicates] = [body.readUInt16BE(8), body.readUInt16BE(10)];
  if (body.length !== 12 + 4 * (gaps + duplicates)) return false;
  let last = 0;
  for (let n = 0; n < gaps; n++) {
    const [start, end] = [body.readUInt16BE(12 + 4 * n), body.readUInt16BE(14 + 4 * n)];
    if (start <= last || end < start) return false;
    last = end;
  }
  return true;
}

function padded(length: number): number {
  return (length + 3) & ~3;
}
