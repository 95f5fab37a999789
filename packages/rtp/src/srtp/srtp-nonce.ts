import { createSecretKey, type KeyObject } from 'node:crypto';

/** Of AES-128, and of its nonces in GCM (RFC 7714 §8.1, §12), bytes. */
const KEY_BYTES = 16;
const NONCE_BYTES = 12;
/** Length of the authentication tag (RFC 7714 §13.2). */
export const SRTP_GCM_TAG_BYTES = 16;
/** The protection profile's number in DTLS-SRTP (RFC 7714 §14.2). */
export const SRTP_AEAD_AES_128_GCM = 7;

/** Key and nonces of SRTP with AES-128-GCM. A nonce is the salt XORed with SSRC and packet index (RFC 7714 §8.1). */
export class SrtpNonce {
  readonly key: KeyObject;
  readonly #salt: Uint8Array;
  readonly #bytes = new Uint8Array(NONCE_BYTES);

  /**
   * @param key session key, 16 bytes
   * @param salt session salt; only the first 12 bytes count (RFC 3711 §4.3)
   * @throws {RangeError} for other sizes
   */
  constructor(key: Uint8Array, salt: Uint8Array) {
    if (key.byteLength !== KEY_BYTES) {
      throw new RangeError(`SRTP key of ${key.byteLength} bytes, ${KEY_BYTES} needed`);
    }
    if (salt.byteLength < NONCE_BYTES) {
      throw new RangeError(`SRTP salt of ${salt.byteLength} bytes, ${NONCE_BYTES} needed`);
    }
    this.key = createSecretKey(key);
    this.#salt = Uint8Array.from(salt.subarray(0, NONCE_BYTES));
  }

  /**
   * @param index the packet's 48-bit index: rollover counter and sequence number (RFC 3711 §3.3.1)
   * @returns 12 bytes, overwritten by the next call
   */
  of(ssrc: number, index: number): Uint8Array {
    const bytes = this.#bytes;
    bytes.set(this.#salt);
    xor32(bytes, 2, ssrc);
    xor32(bytes, 6, Math.floor(index / 0x1_0000));
    bytes[10] = (bytes[10] as number) ^ ((index >> 8) & 0xff);
    bytes[11] = (bytes[11] as number) ^ (index & 0xff);
    return bytes;
  }
}

function xor32(bytes: Uint8Array, at: number, value: number): void {
  bytes[at] = (bytes[at] as number) ^ (value >>> 24);
  bytes[at + 1] = (bytes[at + 1] as number) ^ ((value >>> 16) & 0xff);
  bytes[at + 2] = (bytes[at + 2] as number) ^ ((value >>> 8) & 0xff);
  bytes[at + 3] = (bytes[at + 3] as number) ^ (value & 0xff);
}
