/**
 * The RTP header of every cloud packet (RFC 3550) with two one-byte header extensions (RFC 8285): the m-line's id
 * (RFC 9143) and the transport-wide sequence number. Only four fields change from packet to packet, so it is written
 * once and patched.
 */
import { Buffer } from 'node:buffer';

const FIXED_BYTES = 12;
const EXTENSION_PROFILE_ONE_BYTE = 0xbede;

export interface RtpHeaderParameters {
  /** 0–127. */
  payloadType: number;
  ssrc: number;
  /** `a=mid` of the cloud's m-line, 1–16 ASCII characters. */
  mid: string;
  /** Extension ids 1–14; absent where the peer refused the extension. */
  midExtensionId?: number | undefined;
  transportSequenceExtensionId?: number | undefined;
}

export class RtpHeaderTemplate {
  /** The header as it goes out; owned by the template, valid until the next `patch`. */
  readonly bytes: Buffer;
  readonly #payloadType: number;
  readonly #transportSequenceOffset: number | null;

  constructor(parameters: RtpHeaderParameters) {
    const { payloadType, ssrc, mid, midExtensionId, transportSequenceExtensionId } = parameters;
    const midBytes = Buffer.from(mid, 'ascii');
    if (midBytes.length < 1 || midBytes.length > 16) {
      throw new RangeError(`mid '${mid}' does not fit a one-byte header extension`);
    }
    const elements =
      (transportSequenceExtensionId === undefined ? 0 : 3) +
      (midExtensionId === undefined ? 0 : 1 + midBytes.length);
    const words = Math.ceil(elements / 4);
    const bytes = Buffer.alloc(FIXED_BYTES + 4 + words * 4);
    bytes[0] = 0x90; // version 2, extension
    bytes.writeUInt32BE(ssrc, 8);
    bytes.writeUInt16BE(EXTENSION_PROFILE_ONE_BYTE, 12);
    bytes.writeUInt16BE(words, 14);
    let at = 16;
    if (transportSequenceExtensionId === undefined) {
      this.#transportSequenceOffset = null;
    } else {
      bytes[at] = (transportSequenceExtensionId << 4) | 1;
      this.#transportSequenceOffset = at + 1;
      at += 3;
    }
    if (midExtensionId !== undefined) {
      bytes[at] = (midExtensionId << 4) | (midBytes.length - 1);
      midBytes.copy(bytes, at + 1);
    }
    this.bytes = bytes;
    this.#payloadType = payloadType;
  }

  patch(marker: boolean, sequence: number, timestamp: number, transportSequence: number): void {
    const { bytes } = this;
    bytes[1] = (marker ? 0x80 : 0) | this.#payloadType;
    bytes[2] = sequence >> 8;
    bytes[3] = sequence;
    bytes.writeUInt32BE(timestamp, 4);
    const at = this.#transportSequenceOffset;
    if (at === null) return;
    bytes[at] = transportSequence >> 8;
    bytes[at + 1] = transportSequence;
  }
}
