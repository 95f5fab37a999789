/**
 * Encrypts SRTP for one outgoing stream with AES-128-GCM (RFC 7714 §8). The nonce is derived from SSRC, rollover
 * counter and sequence number. A sealer must therefore be the only one for its SSRC and key, and must never use a
 * sequence number twice, so it counts them itself.
 */
import type { Buffer } from 'node:buffer';
import { createCipheriv } from 'node:crypto';
import { SequenceNumber } from '../sequence-number.ts';
import { SrtpNonce } from './srtp-nonce.ts';

export class SrtpSealer {
  readonly #nonce: SrtpNonce;
  readonly #ssrc: number;
  #index: number;

  /**
   * @param key session key, 16 bytes
   * @param salt session salt, 12 bytes (RFC 3711 §4.3)
   * @param firstSequence of the first packet, below 2¹⁵ so that an early loss cannot be taken for a wrap
   */
  constructor(key: Uint8Array, salt: Uint8Array, ssrc: number, firstSequence: number) {
    this.#nonce = new SrtpNonce(key, salt);
    this.#ssrc = ssrc;
    this.#index = firstSequence & 0x7fff;
  }

  /** The sequence number that the next packet must carry. */
  get nextSequence(): SequenceNumber {
    return SequenceNumber.of(this.#index);
  }

  /**
   * Encrypts one packet whose header carries `nextSequence`, and advances to the next number.
   *
   * @returns header, ciphertext and tag, to be sent in this order; the header is the given one
   */
  seal(header: Buffer, payload: Uint8Array): [Buffer, Buffer, Buffer] {
    const cipher = createCipheriv('aes-128-gcm', this.#nonce.key, this.#nonce.of(this.#ssrc, this.#index++));
    cipher.setAAD(header);
    const sealed = cipher.update(payload);
    cipher.final();
    return [header, sealed, cipher.getAuthTag()];
  }
}
