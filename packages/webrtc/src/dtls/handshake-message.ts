/** Handshake messages of DTLS 1.2 (RFC 6347 §4.2.2): each fragment has a 12-byte header. */

export const HandshakeType = {
  clientHello: 1,
  serverHello: 2,
  helloVerifyRequest: 3,
  certificate: 11,
  serverKeyExchange: 12,
  certificateRequest: 13,
  serverHelloDone: 14,
  certificateVerify: 15,
  clientKeyExchange: 16,
  finished: 20,
} as const;

/** Type, length, sequence number, and the fragment’s place and length (RFC 6347 §4.2.2). */
export const HANDSHAKE_HEADER_BYTES = 12;
/** Certificates are the longest messages. A peer's certificate is self-signed and shorter than 1 KB. */
export const MAX_MESSAGE_BYTES = 16_384;

export interface HandshakeFragment {
  type: number;
  /** Length of the whole message, bytes. */
  length: number;
  messageSequence: number;
  offset: number;
  /** A view into the record. */
  data: Buffer;
}

/** A complete message, in the form in which the transcript includes it: as if it had arrived in one fragment. */
export interface HandshakeMessage {
  type: number;
  messageSequence: number;
  body: Buffer;
}

/** @returns the fragments of a record's plaintext, or `null` if it does not consist of whole fragments */
export function parseHandshakeFragments(plaintext: Buffer): HandshakeFragment[] | null {
  const fragments: HandshakeFragment[] = [];
  let at = 0;
  while (at < plaintext.length) {
    if (plaintext.length - at < HANDSHAKE_HEADER_BYTES) return null;
    const length = plaintext.readUIntBE(at + 1, 3);
    const offset = plaintext.readUIntBE(at + 6, 3);
    const fragmentLength = plaintext.readUIntBE(at + 9, 3);
    const begin = at + HANDSHAKE_HEADER_BYTES;
    const end = begin + fragmentLength;
    if (end > plaintext.length || length > MAX_MESSAGE_BYTES || offset + fragmentLength > length) return null;
    fragments.push({
      type: plaintext.readUInt8(at),
      length,
      messageSequence: plaintext.readUInt16BE(at + 4),
      offset,
      data: plaintext.subarray(begin, end),
    });
    at = end;
  }
  return fragments;
}

export function serializeHandshake({ type, messageSequence, body }: HandshakeMessage): Buffer {
  const header = Buffer.alloc(HANDSHAKE_HEADER_BYTES);
  header.writeUInt8(type, 0);
  header.writeUIntBE(body.length, 1, 3);
  header.writeUInt16BE(messageSequence, 4);
  header.writeUIntBE(body.length, 9, 3);
  return Buffer.concat([header, body]);
}
