/** Deciphers DTLS records of AES-GCM suites (RFC 5288, RFC 6347 §4.1.2). */
import { Buffer } from 'node:buffer';
import { type CipherGCMTypes, createDecipheriv, type KeyObject } from 'node:crypto';
import type { DtlsRecord } from './record.ts';

/** The part of the nonce that a record carries, and its tag (RFC 5288 §3). */
const EXPLICIT_NONCE_BYTES = 8;
const TAG_BYTES = 16;
/** Before the explicit part, which each record carries. */
export const IMPLICIT_NONCE_BYTES = 4;

/** Of one direction. */
export interface RecordKeys {
  algorithm: CipherGCMTypes;
  key: KeyObject | Uint8Array;
  /** Its first {@link IMPLICIT_NONCE_BYTES} count. */
  implicitNonce: Uint8Array;
}

/** @throws if the record is not authentic, and then at little cost: strangers can send such records */
export function openRecord(record: DtlsRecord, { algorithm, key, implicitNonce }: RecordKeys): Buffer {
  const { contentType, version, epoch, sequence, fragment } = record;
  const length = fragment.length - EXPLICIT_NONCE_BYTES - TAG_BYTES;
  if (length < 0) throw new RangeError('too short to be sealed');
  const nonce = Buffer.allocUnsafe(IMPLICIT_NONCE_BYTES + EXPLICIT_NONCE_BYTES);
  nonce.set(implicitNonce.subarray(0, IMPLICIT_NONCE_BYTES));
  fragment.copy(nonce, IMPLICIT_NONCE_BYTES, 0, EXPLICIT_NONCE_BYTES);
  const header = Buffer.allocUnsafe(13);
  header.writeUInt16BE(epoch, 0);
  header.writeUIntBE(sequence, 2, 6);
  header.writeUInt8(contentType, 8);
  header.writeUInt16BE(version, 9);
  header.writeUInt16BE(length, 11);
  const decipher = createDecipheriv(algorithm, key, nonce, { authTagLength: TAG_BYTES });
  decipher.setAuthTag(fragment.subarray(fragment.length - TAG_BYTES));
  decipher.setAAD(header);
  const plaintext = decipher.update(fragment.subarray(EXPLICIT_NONCE_BYTES, EXPLICIT_NONCE_BYTES + length));
  decipher.final();
  return plaintext;
}
