/**
 * Encrypts SRTP for one outgoing stream with AES_CM_128_HMAC_SHA1_80 (RFC 3711 §4.1.1, §4.2.1), for receivers that take
 * no AES-GCM. As with every counter mode, a sealer must be the only one for its SSRC and key, and counts its packets
 * itself, so that none is encrypted twice with the same keystream.
 */
import { createCipheriv, createHmac, createSecretKey, type KeyObject } from 'node:crypto';
import { SequenceNumber } from '../sequence-number.ts';
import { SRTP_CM_TAG_BYTES, type SrtpCmKeys } from './srtp-cm-keys.ts';

export class SrtpCmSealer {
  readonly #key: KeyObject;
  readonly #authenticationKey: KeyObject;
  /** The salt, XORed with the SSRC. */
  readonly #base = Buffer.alloc(16);
  readonly #counter = Buffer.alloc(16);
  readonly #rollover = Buffer.alloc(4);
  #index: number;

  /** @param firstSequence of the first packet, below 2¹⁵ so that an early loss cannot be taken for a wrap */
  constructor({ key, authenticationKey, salt }: SrtpCmKeys, ssrc: number, firstSequence: number) {
    this.#key = createSecretKey(key);
    this.#authenticationKey = createSecretKey(authenticationKey);
    this.#base.set(salt);
    this.#base.writeUInt32BE((this.#base.readUInt32BE(4) ^ ssrc) >>> 0, 4);
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
    const index = this.#index++;
    const counter = this.#counter;
    counter.set(this.#base);
    // The packet's 48-bit index (§3.3.1), in front of the block counter's 16 bits.
    const rollover = Math.floor(index / 0x1_0000);
    counter.writeUInt32BE((counter.readUInt32BE(8) ^ rollover) >>> 0, 8);
    counter.writeUInt16BE(counter.readUInt16BE(12) ^ (index & 0xffff), 12);
    const sealed = createCipheriv('aes-128-ctr', this.#key, counter).update(payload);
    this.#rollover.writeUInt32BE(rollover);
    const tag = createHmac('sha1', this.#authenticationKey)
      .update(header)
      .update(sealed)
      .update(this.#rollover)
      .digest()
      .subarray(0, SRTP_CM_TAG_BYTES);
    return [header, sealed, tag];
  }
}
