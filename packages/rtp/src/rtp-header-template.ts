/**
 * The RTP header of every packet of a stream (RFC 3550) with up to three one-byte header extensions (RFC 8285): the
 * m-line's id (RFC 9143), the transport-wide sequence number and the absolute capture time. Only these and five fields
 * change from packet to packet, so the header is written once and then patched.
 */
import { type NtpTime, writeNtp } from './ntp-time.ts';
import { ONE_BYTE_PROFILE, RTP_FIXED_BYTES } from './rtp-header.ts';

export interface RtpHeaderParameters {
  /** 0–127. */
  payloadType: number;
  ssrc: number;
  /** `a=mid` of the stream's m-line, 1–16 ASCII characters. */
  mid: string;
  /** Extension ids 1–14; absent if the peer refused the extension. */
  midExtensionId?: number | undefined;
  transportSequenceExtensionId?: number | undefined;
  captureTimeExtensionId?: number | undefined;
}

export class RtpHeaderTemplate {
  /** The header as it is sent; owned by the template, valid until the next `patch`. */
  readonly bytes: Uint8Array;
  readonly #view: DataView;
  #payloadType: number;
  readonly #transportSequenceOffset: number | null;
  readonly #captureTimeOffset: number | null;

  constructor(parameters: RtpHeaderParameters) {
    const { payloadType, ssrc, mid, midExtensionId, transportSequenceExtensionId } = parameters;
    const { captureTimeExtensionId } = parameters;
    if (!/^[!-~]{1,16}$/.test(mid)) {
      throw new RangeError(`mid '${mid}' does not fit a one-byte header extension`);
    }
    const elements =
      (transportSequenceExtensionId === undefined ? 0 : 3) +
      (midExtensionId === undefined ? 0 : 1 + mid.length) +
      (captureTimeExtensionId === undefined ? 0 : 9);
    const words = Math.ceil(elements / 4);
    const bytes = new Uint8Array(RTP_FIXED_BYTES + 4 + words * 4);
    const view = new DataView(bytes.buffer);
    bytes[0] = 0x90; // version 2, extension
    view.setUint32(8, ssrc);
    view.setUint16(12, ONE_BYTE_PROFILE);
    view.setUint16(14, words);
    let at = 16;
    if (transportSequenceExtensionId === undefined) {
      this.#transportSequenceOffset = null;
    } else {
      bytes[at] = (transportSequenceExtensionId << 4) | 1;
      this.#transportSequenceOffset = at + 1;
      at += 3;
    }
    if (midExtensionId !== undefined) {
      bytes[at] = (midExtensionId << 4) | (mid.length - 1);
      for (let i = 0; i < mid.length; i++) bytes[at + 1 + i] = mid.charCodeAt(i);
      at += 1 + mid.length;
    }
    if (captureTimeExtensionId === undefined) {
      this.#captureTimeOffset = null;
    } else {
      bytes[at] = (captureTimeExtensionId << 4) | 7;
      this.#captureTimeOffset = at + 1;
    }
    this.bytes = bytes;
    this.#view = view;
    this.#payloadType = payloadType;
  }

  /** Whether packets carry the time at which their content was captured. */
  get hasCaptureTime(): boolean {
    return this.#captureTimeOffset !== null;
  }

  /** The payload type of the next packets, 0–127. */
  patchPayloadType(payloadType: number): void {
    this.#payloadType = payloadType;
  }

  /** The capture time of the next packets; without the extension it is ignored. */
  patchCaptureTime(time: NtpTime): void {
    if (this.#captureTimeOffset !== null) writeNtp(this.#view, this.#captureTimeOffset, time);
  }

  patch(marker: boolean, sequence: number, timestamp: number, transportSequence: number): void {
    const { bytes } = this;
    bytes[1] = (marker ? 0x80 : 0) | this.#payloadType;
    bytes[2] = sequence >> 8;
    bytes[3] = sequence;
    this.#view.setUint32(4, timestamp);
    const at = this.#transportSequenceOffset;
    if (at === null) return;
    bytes[at] = transportSequence >> 8;
    bytes[at + 1] = transportSequence;
  }
}
