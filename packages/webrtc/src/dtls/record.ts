/** DTLS 1.2 records (RFC 6347 §4.1): a 13-byte header, then the fragment. */

export const ContentType = { changeCipherSpec: 20, alert: 21, handshake: 22, applicationData: 23 } as const;

/** Type, version, epoch, sequence number and length. */
export const RECORD_HEADER_BYTES = 13;
/** 2^14 bytes of plaintext, plus what a cipher may add (RFC 5246 §6.2.3). */
const MAX_FRAGMENT_BYTES = 16_384 + 2048;

/** A flight of small records is in one datagram; each record costs a decryption. */
export const MAX_RECORDS = 32;

export interface DtlsRecord {
  contentType: number;
  /** As in the header: 0xfefd is DTLS 1.2, 0xfeff DTLS 1.0. */
  version: number;
  epoch: number;
  /** 48 bits. */
  sequence: number;
  /** A view into the datagram. */
  fragment: Buffer;
}

/**
 * Parses the records of a datagram, as views into it.
 *
 * @returns the complete records before the first malformed one, and whether there was a malformed one: damage does not
 * invalidate the records before it (RFC 6347 §4.1.2.7)
 */
export function parseRecords(datagram: Buffer): { records: DtlsRecord[]; malformed: boolean } {
  const records: DtlsRecord[] = [];
  let at = 0;
  while (at < datagram.length) {
    if (datagram.length - at < RECORD_HEADER_BYTES) return { records, malformed: true };
    const contentType = datagram.readUInt8(at);
    const version = datagram.readUInt16BE(at + 1);
    const length = datagram.readUInt16BE(at + 11);
    const end = at + RECORD_HEADER_BYTES + length;
    const known = contentType >= ContentType.changeCipherSpec && contentType <= ContentType.applicationData;
    const isDtls = version === 0xfefd || version === 0xfeff;
    if (records.length === MAX_RECORDS) return { records, malformed: true };
    if (!known || !isDtls || length === 0 || length > MAX_FRAGMENT_BYTES || end > datagram.length) {
      return { records, malformed: true };
    }
    records.push({
      contentType,
      version,
      epoch: datagram.readUInt16BE(at + 3),
      sequence: datagram.readUIntBE(at + 5, 6),
      fragment: datagram.subarray(at + RECORD_HEADER_BYTES, end),
    });
    at = end;
  }
  return { records, malformed: false };
}
