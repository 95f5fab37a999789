/**
 * Checks that an SCTP packet is framed according to RFC 9260 §3. werift's parser trusts every length in the packet: a
 * chunk or parameter of length 0 would make it loop for ever, an overlapping list of gaps would keep it busy for
 * seconds.
 */

const COMMON_HEADER_BYTES = 12;
const CHUNK_HEADER_BYTES = 4;
const PARAMETER_HEADER_BYTES = 4;
const SACK_CHUNK = 3;

/** Chunks that werift knows: minimum length of the body, and where in it a list of parameters begins. */
const CHUNKS: ReadonlyMap<number, { min: number; parameters?: number }> = new Map([
  [0, { min: 12 }], // DATA
  [1, { min: 16, parameters: 16 }], // INIT
  [2, { min: 16, parameters: 16 }], // INIT ACK
  [SACK_CHUNK, { min: 12 }],
  [4, { min: 0, parameters: 0 }], // HEARTBEAT
  [5, { min: 0, parameters: 0 }], // HEARTBEAT ACK
  [6, { min: 0, parameters: 0 }], // ABORT
  [7, { min: 4 }], // SHUTDOWN
  [8, { min: 0 }], // SHUTDOWN ACK
  [9, { min: 0, parameters: 0 }], // ERROR
  [10, { min: 0 }], // COOKIE ECHO
  [11, { min: 0 }], // COOKIE ACK
  [14, { min: 0 }], // SHUTDOWN COMPLETE
  [130, { min: 0, parameters: 0 }], // RE-CONFIG (RFC 6525)
  [192, { min: 4 }], // FORWARD TSN (RFC 3758)
]);

export function isSctpPacket(packet: Buffer): boolean {
  let at = COMMON_HEADER_BYTES;
  if (packet.length < at + CHUNK_HEADER_BYTES) return false;
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

function isChunk(type: number, body: Buffer): boolean {
  const known = CHUNKS.get(type);
  if (known === undefined || body.length < known.min) return false;
  if (known.parameters !== undefined) return areParameters(body.subarray(known.parameters));
  if (type === SACK_CHUNK) return isSack(body);
  // A list of streams and their numbers, 4 bytes each.
  return type !== 192 || body.length % 4 === 0;
}

function areParameters(list: Buffer): boolean {
  let at = 0;
  while (at < list.length) {
    if (list.length - at < PARAMETER_HEADER_BYTES) return false;
    const length = list.readUInt16BE(at + 2);
    if (length < PARAMETER_HEADER_BYTES || at + length > list.length) return false;
    at += padded(length);
  }
  return true;
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
