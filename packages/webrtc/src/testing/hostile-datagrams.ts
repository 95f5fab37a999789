/** For tests: what strangers and misbehaving peers send to a session's sockets. Bytes only; sending is the caller's. */
import { crc32c, Message } from 'werift';
import { dtlsRecord } from './dtls-record.ts';

/** DTLS 1.2, epoch 0: a warning that closes the session, 15 bytes. */
export const closeAlert = dtlsRecord(21, 0, 0, Uint8Array.of(1, 0));
/** Epoch 0: a fatal handshake failure. */
export const fatalAlert = dtlsRecord(21, 0, 0, Uint8Array.of(2, 40));

/** A ClientHello that begins another handshake. @param random fills its 32 random bytes */
export function clientHello(random = 7, sequence = 0): Buffer {
  const body = [0xfe, 0xfd, ...filled(32, random), 0, 0, 0, 2, 0xc0, 0x2b, 1, 0, ...filled(38, 0)];
  return handshakeRecord(1, body, sequence);
}

/** A plaintext handshake message in one record. */
export function handshakeRecord(type: number, body: readonly number[], sequence = 0): Buffer {
  const length = [body.length >> 16, (body.length >> 8) & 255, body.length & 255];
  return dtlsRecord(22, 0, sequence, Uint8Array.of(type, ...length, 0, 0, 0, 0, 0, ...length, ...body));
}

export interface CheckOptions {
  /** `robot's fragment:operator's fragment`. */
  username: string;
  /** Seals it with this password; without a seal if undefined. */
  password?: string | undefined;
  /** Asks to use this path from now on. */
  nominate?: boolean | undefined;
}

/** A STUN binding request as ICE sends it (RFC 8445 §7). */
export function connectivityCheck({ username, password, nominate = true }: CheckOptions): Buffer {
  const check = new Message(1, 0)
    .setAttribute('USERNAME', username)
    .setAttribute('PRIORITY', 0x7fffffff)
    .setAttribute('ICE-CONTROLLING', 2n ** 64n - 1n);
  if (nominate) check.setAttribute('USE-CANDIDATE', null);
  if (password !== undefined) check.addMessageIntegrity(Buffer.from(password));
  return check.bytes;
}

/** A success response to nobody's request, which claims this address for the receiver. */
export function strayResponse(): Buffer {
  return new Message(1, 0x100).setAttribute('XOR-MAPPED-ADDRESS', ['192.0.2.1', 9]).bytes;
}

/** An SRTP packet of the right shape, with bytes in place of its cipher text and tag. */
export function noiseRtp(payloadType: number, ssrc: number, sequence: number, length = 200): Buffer {
  const packet = Buffer.alloc(length, 0xa5);
  packet.writeUInt8(0x80, 0);
  packet.writeUInt8(payloadType & 0x7f, 1);
  packet.writeUInt16BE(sequence & 0xffff, 2);
  packet.writeUInt32BE(sequence, 4);
  packet.writeUInt32BE(ssrc >>> 0, 8);
  return packet;
}

/** An SRTCP packet of the right shape. @param type 200 sender report … 206 payload feedback */
export function noiseRtcp(type: number, format = 15, length = 60): Buffer {
  const packet = Buffer.alloc(length, 0x5a);
  packet.writeUInt8(0x80 | format, 0);
  packet.writeUInt8(type, 1);
  packet.writeUInt16BE(Math.floor(length / 4) - 1, 2);
  return packet;
}

/** An SCTP packet with a valid checksum, whatever its chunks are. */
export function sctpPacket(verificationTag: number, ...chunks: readonly number[]): Buffer {
  const bytes = Buffer.alloc(12 + chunks.length);
  bytes.writeUInt16BE(5000, 0);
  bytes.writeUInt16BE(5000, 2);
  bytes.writeUInt32BE(verificationTag >>> 0, 4);
  bytes.set(chunks, 12);
  bytes.writeUInt32LE(crc32c(bytes), 8);
  return bytes;
}

/** Malformed chunks, by what is wrong with them. */
export const malformedChunks: ReadonlyMap<string, readonly number[]> = new Map([
  ['a chunk of length 0', [0, 0, 0, 0]],
  ['a parameter of length 0', [130, 0, 0, 8, 0, 13, 0, 0]],
  ['an unknown chunk', [77, 0, 0, 4]],
  ['two INITs', [...initChunk(), ...initChunk()]],
  ['a SACK without its gaps', [3, 0, 0, 16, ...filled(8, 0), 0, 9, 0, 0]],
  ['gaps that overlap', [3, 0, 0, 24, ...filled(8, 0), 0, 2, 0, 0, 0, 1, 0, 9, 0, 5, 0, 12]],
]);

/** A DATA chunk of one byte: a complete message. */
export function dataChunk(tsn: number, streamId: number, flags = 3): number[] {
  const number = [tsn >>> 24, (tsn >> 16) & 255, (tsn >> 8) & 255, tsn & 255];
  return [0, flags, 0, 17, ...number, streamId >> 8, streamId & 255, 0, 0, 0, 0, 0, 53, 120, 0, 0, 0];
}

function initChunk(): number[] {
  return [1, 0, 0, 20, ...filled(16, 1)];
}

function filled(length: number, value: number): number[] {
  return new Array(length).fill(value);
}
