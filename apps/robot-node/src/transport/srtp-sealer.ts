/**
 * SRTP for one outgoing stream with AES-128-GCM (RFC 7714 §8). The nonce is derived from SSRC, rollover counter and
 * sequence number, so a sealer must be the only one that seals for its SSRC under its key, and no sequence number is
 * ever sealed twice: the sealer counts them itself.
 */
import type { Buffer } from 'node:buffer';
import { createCipheriv, createSecretKey, type KeyObject } from 'node:crypto';

export const SRTP_GCM_TAG_BYTES = 16;
const NONCE_BYTES = 12;

export class SrtpSealer {
  readonly #key: KeyObject;
  readonly #salt: Uint8Array;
  readonly #ssrc: number;
  readonly #nonce = new Uint8Array(NONCE_BYTES);
  #index: number;

  /**
   * @param key session key, 16 bytes; @param salt session salt, 12 bytes (RFC 3711 §4.3)
   * @param firstSequence of the first packet, below 2¹⁵ so that an early loss cannot be taken for a wrap
   */
  constructor(key: Uint8Array, salt: Uint8Array, ssrc: number, firstSequence: number) {
    if (key.byteLength !== 16) throw new RangeError(`SRTP key of ${key.byteLength} bytes, 16 needed`);
    if (salt.byteLength < NONCE_BYTES)
      throw new RangeError(`SRTP salt of ${salt.byteLength} bytes, 12 needed`);
    this.#key = createSecretKey(key);
    this.#salt = Uint8Array.from(salt.subarray(0, NONCE_BYTES));
    this.#ssrc = ssrc;
    this.#index = firstSequence & 0x7fff;
  }

  /** The sequence number that the next sealed packet must carry. */
  get nextSequence(): number {
    return this.#index & 0xffff;
  }

  /**
   * Seals one packet whose header carries `nextSequence`, and moves on to the next.
   *
   * @returns header, ciphertext and tag, to be sent in this order; the header is the given one
   */
  seal(header: Buffer, payload: Uint8Array): [Buffer, Buffer, Buffer] {
    const nonce = this.#nonce;
    const salt = this.#salt;
    const index = this.#index++;
    const rollover = Math.floor(index / 0x1_0000);
    for (let i = 0; i < NONCE_BYTES; i++) nonce[i] = salt[i] as number;
    xor32(nonce, 2, this.#ssrc);
    xor32(nonce, 6, rollover);
    nonce[10] = (nonce[10] as number) ^ ((index >> 8) & 0xff);
    nonce[11] = (nonce[11] as number) ^ (index & 0xff);
    const cipher = createCipheriv('aes-128-gcm', this.#key, nonce);
    cipher.setAAD(header);
    const sealed = cipher.update(payload);
    cipher.final();
    return [header, sealed, cipher.getAuthTag()];
  }
}

function xor32(bytes: Uint8Array, at: number, value: number): void {
  bytes[at] = (bytes[at] as number) ^ (value >>> 24);
  bytes[at + 1] = (bytes[at + 1] as number) ^ ((value >>> 16) & 0xff);
  bytes[at + 2] = (bytes[at + 2] as number) ^ ((value >>> 8) & 0xff);
  bytes[at + 3] = (bytes[at + 3] as number) ^ (value & 0xff);
}
