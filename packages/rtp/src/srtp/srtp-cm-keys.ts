/** Session keys of SRTP with AES in counter mode and HMAC-SHA1, derived once from the master key (RFC 3711 §4.3). */
import { createCipheriv } from 'node:crypto';

/** Session key, salt and authentication key (RFC 3711 §8.2), bytes. */
const KEY_BYTES = 16;
const SALT_BYTES = 14;
const AUTHENTICATION_KEY_BYTES = 20;
/** Length of the authentication tag of the suite AES_CM_128_HMAC_SHA1_80 (RFC 4568 §6.2.1). */
export const SRTP_CM_TAG_BYTES = 10;
/** Length of master key and salt together, as SDES and Janus take them, bytes. */
export const SRTP_CM_MASTER_BYTES = KEY_BYTES + SALT_BYTES;

export interface SrtpCmKeys {
  /** 16 bytes. */
  key: Buffer;
  /** 20 bytes. */
  authenticationKey: Buffer;
  /** 14 bytes. */
  salt: Buffer;
}

/**
 * The keys of RTP, not of RTCP, for a key derivation rate of 0.
 *
 * @param master key and salt: 16 and 14 bytes
 * @throws {RangeError} for other sizes
 */
export function deriveSrtpCmKeys(master: Uint8Array): SrtpCmKeys {
  if (master.byteLength !== SRTP_CM_MASTER_BYTES)
    throw new RangeError(`SRTP master key of ${master.byteLength} bytes, ${SRTP_CM_MASTER_BYTES} needed`);
  const derive = (label: number, bytes: number): Buffer => {
    const counter = Buffer.alloc(KEY_BYTES);
    counter.set(master.subarray(KEY_BYTES));
    // The label's place: the salt's 112 bits end with the 48 bits of the index.
    counter[7] = (counter[7] as number) ^ label;
    const cipher = createCipheriv('aes-128-ctr', master.subarray(0, KEY_BYTES), counter);
    return cipher.update(Buffer.alloc(bytes));
  };
  return {
    key: derive(0, KEY_BYTES),
    authenticationKey: derive(1, AUTHENTICATION_KEY_BYTES),
    salt: derive(2, SALT_BYTES),
  };
}
